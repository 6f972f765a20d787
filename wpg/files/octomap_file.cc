#include "wpg/files/octomap_file.h"

#include <octomap/OcTree.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <string_view>
#include <vector>

#include "wpg/files/input_error.h"
#include "wpg/files/mesh_text.h"
#include "wpg/files/regular_file.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

constexpr long kMostNodes = 20'000'000;
constexpr int kLevels = 16;
constexpr int kMiddle = 1 << (kLevels - 1);  // the key of the cell at the origin

struct Header {
  double resolution = 0.0;
  long nodes = -1;
  size_t data = 0;  // where the tree begins
};

Header ReadHeader(const std::string& path, std::string_view bytes, bool binary) {
  const std::string_view first = binary ? "# Octomap OcTree binary file" : "# Octomap OcTree file";
  MeshText text(path, bytes);
  if (!bytes.starts_with(first)) {
    text.Fail(text.NextInLine(), "the first line is not `" + std::string(first) + "`");
  }
  Header header;
  bool has_id = false;
  for (;;) {
    text.SkipLine();
    const MeshWord word = text.NextInLine();
    if (word.text.empty() && text.AtEnd()) {
      text.Fail(word, "the file ends within its header (valid: data)");
    }
    if (word.text.empty() || word.text[0] == '#') continue;
    if (word.text == "data") {
      if (!has_id) text.Fail(word, "the header names no id");
      if (header.nodes < 1) text.Fail(word, "the header names no size, or nothing is known");
      if (header.resolution == 0.0) text.Fail(word, "the header names no res");
      text.SkipLine();
      header.data = text.offset();
      return header;
    }
    const MeshWord value = text.NextInLine();
    if (word.text == "id") {
      if (value.text != "OcTree") {
        text.Fail(value, "a tree of the kind " + Quote(value.text) + " (valid: OcTree)");
      }
      has_id = true;
    } else if (word.text == "size") {
      const double size = text.Number(value);
      if (!(size >= 0 && size <= kMostNodes && size == std::floor(size))) {
        text.Fail(value, Quote(value.text) + " nodes (valid: 1 … 20 million)");
      }
      header.nodes = static_cast<long>(size);
    } else if (word.text == "res") {
      header.resolution = text.Number(value);
      if (!(header.resolution >= 1e-4 && header.resolution <= 10)) {
        text.Fail(value, Quote(value.text) + " is no resolution (valid: 0.0001 … 10 m)");
      }
    } else {
      text.Fail(word, Quote(word.text) + " (valid: id, size, res, data)");
    }
  }
}

// Walks over the tree as the library will, without building it.
void CheckTree(const std::string& path, std::string_view bytes, const Header& header, bool binary) {
  size_t at = header.data;
  const auto need = [&](size_t count) {
    if (count > bytes.size() - at) RefuseByte(path, bytes.size(), "the file ends within its tree");
  };
  long nodes = 1;
  std::vector<int> open = {0};  // levels of the nodes that are to be read
  while (!open.empty()) {
    const int level = open.back();
    open.pop_back();
    const size_t begin = at;
    int children = 0, inner = 0;
    if (binary) {
      need(2);
      for (int i = 0; i < 8; ++i) {
        const int pair =
            (static_cast<unsigned char>(Nth(bytes, at + (i / 4))) >> (2 * (i % 4))) & 3;
        children += pair != 0 ? 1 : 0;
        inner += pair == 3 ? 1 : 0;
      }
      at += 2;
      if (children == 0) RefuseByte(path, begin, "an inner node without children");
    } else {
      need(5);
      float log_odds = 0;
      std::memcpy(&log_odds, bytes.data() + at, sizeof log_odds);
      if (!std::isfinite(log_odds)) RefuseByte(path, begin, "a number that is not finite");
      for (int i = 0; i < 8; ++i) children += (static_cast<unsigned char>(bytes[at + 4]) >> i) & 1;
      inner = children;
      at += 5;
    }
    if (children > 0 && level == kLevels) {
      RefuseByte(path, begin, "a tree deeper than 16 levels");
    }
    if (inner > 0 && binary && level + 1 == kLevels) {
      RefuseByte(path, begin, "a tree deeper than 16 levels");
    }
    nodes += children;
    if (nodes > header.nodes) break;
    open.insert(open.end(), static_cast<size_t>(inner), level + 1);
  }
  if (nodes != header.nodes) {
    RefuseByte(path, at,
               "the tree has another number of nodes than the header's size says, " +
                   std::to_string(header.nodes));
  }
  if (at != bytes.size()) RefuseByte(path, at, "the tree ends here, but not the file");
}

}  // namespace

LoadedOctomap LoadOctomap(const std::string& path) {
  FileBytes file = TryReadRegularFile(path, kMaxMeshBytes);
  if (!file.refused.empty()) throw InputError({path + ": " + file.refused});
  return ParseOctomap(path, file.bytes);
}

LoadedOctomap ParseOctomap(const std::string& path, const std::string& bytes) {
  const std::string extension = std::filesystem::path(path).extension().string();
  const bool binary = extension == ".bt";
  if (!binary && extension != ".ot") {
    throw InputError({path + ": another kind of file (valid: .bt, .ot)"});
  }
  const Header header = ReadHeader(path, bytes, binary);
  CheckTree(path, bytes, header, binary);
  // The data only: its functions for whole files print.
  std::istringstream stream(bytes.substr(header.data));
  octomap::OcTree tree(header.resolution);
  binary ? tree.readBinaryData(stream) : tree.readData(stream);
  if (!stream || static_cast<long>(tree.size()) != header.nodes) {
    throw InputError({path + ": octomap reads another number of nodes than stand in the file"});
  }
  LoadedOctomap loaded;
  loaded.resolution = header.resolution;
  for (auto leaf = tree.begin_leafs(), end = tree.end_leafs(); leaf != end; ++leaf) {
    const octomap::OcTreeKey key = leaf.getIndexKey();
    loaded.cubes.push_back({{key[0] - kMiddle, key[1] - kMiddle, key[2] - kMiddle},
                            1 << (kLevels - static_cast<int>(leaf.getDepth())),
                            tree.isNodeOccupied(*leaf)});
  }
  if (loaded.cubes.empty()) throw InputError({path + ": nothing is known"});
  loaded.file = RecordOf(path, bytes);
  return loaded;
}

}  // namespace halfstep
