#!/usr/bin/env python3
"""Fails when a link of a page leads nowhere, or a comment names a section that is not there.

links_test.py [ROOT]. Looked at are all pages and sources under version control, or all below ROOT:
- links of pages to files, and to headings (by GitHub's rule) or ids of Markdown pages;
- `PAGE.md, "Section" and "Section"` and `PAGE.md#anchor` in sources: PAGE is a path from ROOT, or
  stands beside the source. A section is a heading, an id, or emphasized words that begin a line.
"""
import pathlib
import posixpath
import re
import subprocess
import sys
import tempfile
from urllib.parse import unquote

ROOT = pathlib.Path(__file__).resolve().parents[2]
SOURCES = (".h", ".cc", ".py", ".pyi", ".js", ".mjs", ".sh", ".dox", ".v")
LINK = re.compile(r"\]\(<?([^)\s>]+)>?(?: +\"[^\"]*\")?\)|^\[[^\]]+\]: (\S+)|"
                  r"\b(?:href|src)=\"([^\"]+)\"")
NAMED = re.compile(r"((?:\w[\w.-]*/)*\w[\w.-]*\.md)"
                   r"(?:#([\w-]+)|,? ((?:\"[^\"]+\"(?:,? and |, )?)+))")


def files(root):
    """Names of the files, from the root."""
    listed = subprocess.run(["git", "ls-files"], cwd=root, capture_output=True, text=True)
    if listed.returncode == 0:
        return [name for name in listed.stdout.split("\n") if (root / name).is_file()]
    skipped = {"build", "node_modules", ".git", "runs"}
    return [path.relative_to(root).as_posix() for path in root.rglob("*")
            if path.is_file() and not skipped & set(path.relative_to(root).parts)]


def slug(words):
    """GitHub's anchor of a heading."""
    words = re.sub(r"<[^>]*>", "", re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", words))
    return re.sub(r"[^\w\- ]", "", words.strip().lower()).replace(" ", "-")


class Page:
    def __init__(self, text):
        self.lines, self.anchors, self.begins, seen, fence = [], set(), set(), {}, ""
        for line in text.split("\n"):
            mark = re.match(r" {0,3}(```+|~~~+)", line)
            if mark and (not fence or line.strip() == fence):
                fence = "" if fence else mark[1]
            line = "" if fence or mark or line.startswith("    ") else line
            self.lines.append(line)
            self.anchors.update(re.findall(r"<\w+ (?:id|name)=\"([^\"]+)\"", line))
            heading = re.match(r" {0,3}#{1,6} +(.*?)[ #]*$", line)
            if heading:
                anchor = slug(heading[1])
                seen[anchor] = seen.get(anchor, -1) + 1
                self.anchors.add(f"{anchor}-{seen[anchor]}" if seen[anchor] else anchor)
            begins = re.match(r"(?:<[^>]*>)*(?:[-*] )?(\*\*?)(.+?)\1", line)
            self.begins.update([slug(begins[2])] if begins else [])


def wrong_links(name, pages, there):
    """Of a page."""
    for number, line in enumerate(pages[name].lines, 1):
        for link in map("".join, LINK.findall(re.sub(r"`[^`]*`", "", line))):
            path, _, anchor = unquote(link).partition("#")
            target = posixpath.join(posixpath.dirname(name), path) if path else name
            target = posixpath.normpath(target)
            if re.match(r"[a-z]+:|//", link):
                continue
            if target not in there:
                yield f"{name}:{number}: {link}: there is no such file"
            page = pages.get(target) or pages.get(f"{target}/README.md")
            if page and anchor and anchor not in page.anchors:
                yield f"{name}:{number}: {link}: there is no such heading"


def wrong_names(name, text, pages):
    """Of a source: in comments and texts, which may go on in the next line."""
    text = re.sub(r"\"\n\s*\"", "", text.replace('\\"', '"'))
    text = re.sub(r"\n\s*(?://+|#|\*)? *", " ", text)
    for page, anchor, sections in NAMED.findall(text):
        known = pages.get(posixpath.join(posixpath.dirname(name), page)) or pages.get(page)
        if not known:
            yield f"{name}: {page}: there is no such page"
        elif anchor and anchor not in known.anchors:
            yield f"{name}: {page}#{anchor}: there is no such heading"
        for section in re.findall(r"\"([^\"]+)\"", sections if known else ""):
            if slug(section) not in known.anchors | known.begins:
                yield f'{name}: {page}, "{section}": there is no such heading'


def wrong(root):
    names = [name for name in files(root) if name != "tests/pages/links_test.py"]
    there = {*names, *(str(up) for name in names for up in pathlib.PurePath(name).parents)}
    texts = {name: (root / name).read_text(encoding="utf-8", errors="replace") for name in names
             if name.endswith((".md", *SOURCES))}
    pages = {name: Page(text) for name, text in texts.items() if name.endswith(".md")}
    told = [line for name in pages for line in wrong_links(name, pages, there)]
    told += [line for name in texts if name not in pages and ".md" in texts[name]
             for line in wrong_names(name, texts[name], pages)]
    return told if pages else ["no page was found"]


def controls():
    """A folder with things that are wrong beside such that are right."""
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        (root / "a.md").write_text('# A `b_c`: d\n\n**Lead.** [x](a.md#a-b_c-d) [y](#i) <a id="i">'
                                   "\n[z](b.md) [z](a.md#gone)\n\n    [code](c.md)\n")
        (root / "a.h").write_text('/// a.md, "A b_c: d" and "Lead"; a.md#i; a.md, "A\n/// b"\n')
        found = [line.partition(": there is")[0] for line in wrong(root)]
        right = ["a.md:4: b.md", "a.md:4: a.md#gone", 'a.h: a.md, "A b"']
        return [] if found == right else [f"of {right} were found {found}"]


if __name__ == "__main__":
    faults = controls() + wrong(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ROOT).resolve())
    print("\n".join(faults))
    sys.exit(1 if faults else 0)
