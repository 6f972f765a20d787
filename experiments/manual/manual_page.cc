#include "experiments/manual/manual_page.h"

#include <algorithm>
#include <string_view>

#include "experiments/manual/option_words.h"
#include "experiments/run/exit_status.h"

namespace halfstep {
namespace {

// A text that groff prints as it is; a line of it must not look like a request.
std::string Escaped(std::string_view text) {
  std::string escaped = text.starts_with('.') || text.starts_with('\'') ? "\\&" : "";
  for (const char c : text) {
    if (c == '\\') {
      escaped += "\\e";
    } else if (c == '-') {
      escaped += "\\-";
    } else {
      escaped += c;
    }
  }
  return escaped;
}

std::string Bold(std::string_view text) { return "\\fB" + Escaped(text) + "\\fR"; }
std::string Italic(std::string_view text) { return "\\fI" + Escaped(text) + "\\fR"; }

std::string Item(const std::string& term, std::string_view meaning) {
  return ".TP\n" + term + "\n" + Escaped(meaning) + "\n";
}

std::string TermOf(const CLI::Option& option) {
  const std::string value = ValueOf(option);
  if (option.get_positional()) return Italic(value);
  std::string term;
  for (const std::string& name : NamesOf(option)) term += (term.empty() ? "" : ", ") + Bold(name);
  return value.empty() ? term : term + " " + Italic(value);
}

// A description is a sentence and, behind an empty line, examples.
std::string Described(const std::string& description) {
  const size_t gap = description.find("\n\n");
  std::string text = ".PP\n" + Escaped(description.substr(0, gap)) + "\n";
  if (gap == std::string::npos) return text;
  text += ".PP\n.EX\n";
  for (size_t begin = gap + 2; begin < description.size();) {
    const size_t end = std::min(description.find('\n', begin), description.size());
    text += Escaped(description.substr(begin, end - begin)) + "\n";
    begin = end + 1;
  }
  return text + ".EE\n";
}

std::string SectionOf(const CLI::App& command) {
  std::string synopsis = command.get_name();
  std::string items;
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_positional()) {
      const std::string value = ValueOf(*option);
      synopsis += option->get_required() ? " " + value : " [" + value + "]";
    }
    if (option == command.get_help_ptr()) continue;  // as of the program
    items += Item(TermOf(*option), option->get_description());
  }
  return ".SS \"" + Escaped(synopsis) + "\"\n" + Described(command.get_description()) + items;
}

std::string Status(ExitStatus status, std::string_view meaning) {
  return Item(Bold(std::to_string(status)), meaning);
}

std::string ExitStatuses() {
  return ".SH EXIT STATUS\n" + Status(kSuccess, "done") +
         Status(kFailed, "the purpose failed: no plan, no certificate, a fall, a full disk") +
         Status(kBadInput, "what the user wrote is wrong; nothing was written") +
         Status(kNotVerified, "verify disagrees with a certificate") +
         Status(kTooCoarse, "verify agrees, but rows are too far apart to vouch for all motion") +
         Status(kInterrupted, "interrupted; what was written is whole and proved");
}

constexpr std::string_view kSurroundings =
    ".SH FILES\n"
    ".TP\n\\fIruns/NAME\\fR\nfolder of a run, unless the config or \\-\\-out names another\n"
    ".TP\n\\fI$XDG_CACHE_HOME/halfstep\\fR\nswept volumes that were baked (default: "
    "\\fI~/.cache/halfstep\\fR)\n"
    ".SH ENVIRONMENT\n"
    ".TP\n\\fBHALFSTEP_DATA\\fR\nfolder of shipped configs, episodes, scenes, sweeps and robots\n";

}  // namespace

std::string ManualPage(const CLI::App& app, const std::string& version) {
  std::string page =
      ".\\\" -*- coding: utf-8 -*-\n"
      ".TH HALFSTEP 1 \"\" \"halfstep " +
      version +
      "\" \"User Commands\"\n"
      ".SH NAME\n" +
      "halfstep \\- plans and smooths humanoid walks, and proves them for all time\n" +
      ".SH SYNOPSIS\n.B halfstep\n.I COMMAND\n[\\fIOPTIONS\\fR]\n.SH DESCRIPTION\n" +
      Described(app.get_description()) + ".SH OPTIONS\n";
  for (const CLI::Option* option : app.get_options()) {
    page += Item(TermOf(*option), option->get_description());
  }
  page += ".SH COMMANDS\n";
  for (const CLI::App* command : CommandsOf(app)) page += SectionOf(*command);
  return page + ExitStatuses() + std::string(kSurroundings);
}

}  // namespace halfstep
