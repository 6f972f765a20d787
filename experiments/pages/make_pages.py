#!/usr/bin/python3
"""Makes the folder of pages: make_pages.py OUT (build.sh says what it needs).

Texts become HTML with the files that they refer to beside them; links between them are checked.
Exit status 1: an item of C++ is not documented, a link leads nowhere, or a page would load
something from a network.
"""

import html
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
from urllib.parse import unquote

ROOT = pathlib.Path(__file__).resolve().parents[2]
STYLE = """
body { font: 16px/1.5 sans-serif; margin: 0 auto; max-width: 60em; padding: 1em; }
nav { border-bottom: 1px solid #888; padding-bottom: .5em; } nav a { margin-right: 1em; }
pre { background: #8881; overflow-x: auto; padding: .6em; } code { font-size: 90%; }
table { border-collapse: collapse; display: block; overflow-x: auto; }
td, th { border: 1px solid #888; padding: .2em .5em; text-align: left; vertical-align: top; }
img { max-width: 100%; } img[align=right] { margin-left: 1em; } :root { color-scheme: light dark; }
"""
MENU = {"README.md": "halfstep", "experiments/tutorial.md": "Tutorial", "examples.html": "Examples",
        "cpp/index.html": "C++", "python/halfstep.html": "Python",
        "experiments/README.md": "Command", "experiments/config.md": "Config",
        "experiments/files.md": "Files", "smoothing/README.md": "Smoothing",
        "planner/README.md": "Planner", "wpg/README.md": "Walking", "opt/README.md": "Solvers",
        "notebooks-data/measurements.md": "Measurements"}


def texts():
    skipped = {"build", "node_modules", "runs", ".git", "pages"}
    return sorted(path.relative_to(ROOT).as_posix() for path in ROOT.rglob("*.md")
                  if not skipped & set(path.relative_to(ROOT).parts))


def html_name(name):
    return "index.html" if name == "README.md" else re.sub(r"\.md$", ".html", name)


class Pages:
    def __init__(self, out):
        self.out, self.faults, self.texts = out, [], texts()

    def write(self, name, title, body):
        up = "../" * name.count("/")
        menu = " ".join(f'<a href="{up}{html_name(target)}">{text}</a>'
                        for target, text in MENU.items()
                        if target in self.texts or (self.out / target).exists()
                        or target == "examples.html")
        path = self.out / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
                        f'<meta name="viewport" content="width=device-width">'
                        f"<title>{html.escape(title)}</title><style>{STYLE}</style></head>\n"
                        f"<body><nav>{menu}</nav>\n{body}</body></html>\n", encoding="utf-8")

    def anchored(self, body):
        """Headings get the anchors that links to them use."""
        seen = {}

        def anchor(match):
            words = html.unescape(re.sub(r"<[^>]*>", "", match[2])).lower()
            slug = re.sub(r"[^\w\- ]", "", words).replace(" ", "-")
            seen[slug] = seen.get(slug, -1) + 1
            slug += f"-{seen[slug]}" if seen[slug] else ""
            return f'<h{match[1]} id="{slug}">{match[2]}</h{match[1]}>'
        return re.sub(r"<h(\d)>(.*?)</h\1>", anchor, body)

    def target(self, folder, link):
        """Where a link of a text in `folder` leads to in the pages; what it names is copied."""
        if re.match(r"[a-z]+:|#", link):
            return link
        path, mark, place = link.partition("#")
        path = os.path.normpath(os.path.join(folder, unquote(path)))
        if (ROOT / path / "README.md").is_file():
            path = os.path.join(path, "README.md")
        elif (ROOT / path).is_dir():
            return os.path.relpath(self.listing(path), folder or ".")
        if path in self.texts:
            path = html_name(path)
        elif (ROOT / path).is_file():
            (self.out / path).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / path, self.out / path)
        return os.path.relpath(path, folder or ".") + mark + place

    def listing(self, folder):
        page = f"{folder}/index.html"
        if not (self.out / page).exists():
            names = sorted(path.name for path in (ROOT / folder).iterdir()
                           if path.is_file() and path.stat().st_size < 1 << 20)
            (self.out / folder).mkdir(parents=True, exist_ok=True)
            for name in names:
                shutil.copy(ROOT / folder / name, self.out / folder / name)
            self.write(page, folder, f"<h1>{folder}</h1>\n<ul>" + "".join(
                f'<li><a href="{name}">{name}</a></li>\n' for name in names) + "</ul>\n")
        return page

    def text(self, name):
        source = (ROOT / name).read_text(encoding="utf-8")
        body = subprocess.run(["cmark-gfm", "--unsafe", "-e", "table", "-e", "strikethrough"],
                              input=source, text=True, capture_output=True, check=True).stdout
        folder = os.path.dirname(name)
        body = re.sub(r'(href|src)="([^"]*)"', lambda m: m[1] + '="' + html.escape(
            self.target(folder, html.unescape(m[2]))) + '"', self.anchored(body))
        title = re.search(r"^# (.*)", source, re.M)
        self.write(html_name(name), title[1] if title else name, body)

    def examples(self):
        body = "<h1>Examples</h1>\n<p>Each has one new idea; all run in the tests.</p>\n"
        for path in sorted((ROOT / "experiments/examples").glob("[0-9][0-9]_*.*")):
            language = {".cc": "C++", ".py": "Python"}.get(path.suffix)
            if language:
                name = path.stem[:2] + " " + path.stem[3:].replace("_", " ")
                body += (f'<h2 id="{path.name}">{name} ({language})</h2>\n<pre><code>'
                         f"{html.escape(path.read_text(encoding='utf-8'))}</code></pre>\n")
        self.write("examples.html", "Examples", body)

    def cpp(self):
        (self.out / "cpp").mkdir(parents=True)
        done = subprocess.run(["doxygen", "experiments/pages/Doxyfile"], cwd=ROOT, text=True,
                              capture_output=True, env=os.environ | {"HALFSTEP_PAGES": self.out})
        self.faults += done.stderr.splitlines()
        if done.returncode:
            self.faults.append(f"doxygen: exit status {done.returncode}")

    def python(self):
        module = ROOT / "build/release/python"
        if not (module / "halfstep").is_dir():
            print("No Python reference: build/release/python has no module", file=sys.stderr)
            return
        (self.out / "python").mkdir()
        subprocess.run(["/usr/bin/python3", ROOT / "experiments/pages/python_reference.py",
                        self.out / "python/halfstep.html"], check=True,
                       env=os.environ | {"PYTHONPATH": str(module)})

    def check(self):
        anchors = {}
        for page in self.out.rglob("*.html"):
            text = page.read_text(encoding="utf-8")
            anchors[page.resolve()] = set(re.findall(r'(?:id|name)="([^"]*)"', text))
            loads = r'<(?:script|img|link|iframe)[^>]*(?:src|href)="(https?:[^"]*)"'
            for loaded in re.findall(loads, text):
                self.faults.append(f"{page}: loads {loaded}")
        for name in self.texts:
            page = self.out / html_name(name)
            for link in re.findall(r'(?:href|src)="([^"]*)"', page.read_text(encoding="utf-8")):
                if re.match(r"[a-z]+:", link):
                    continue
                path, _, place = html.unescape(link).partition("#")
                other = (page.parent / unquote(path)).resolve() if path else page.resolve()
                if not other.exists() or (
                        place and other in anchors and unquote(place) not in anchors[other]):
                    self.faults.append(f"{name}: {link} leads nowhere")


def main(out):
    out.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=out.parent, prefix=".pages.partial-") as partial:
        pages = Pages(pathlib.Path(partial) / "pages")
        pages.out.mkdir()
        pages.cpp()
        pages.python()
        pages.examples()
        for name in pages.texts:
            pages.text(name)
        pages.check()
        print("\n".join(pages.faults), end="\n" if pages.faults else "", file=sys.stderr)
        if out.exists():
            if not (out / "cpp").is_dir():
                sys.exit(f"{out} is there and has no pages in it; nothing is written")
            shutil.rmtree(out)
        pages.out.rename(out)
    print(f"{out}/index.html: {len(pages.texts)} texts, {len(list(out.rglob('*.html')))} pages")
    return 1 if pages.faults else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve()))
