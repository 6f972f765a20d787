#!/usr/bin/python3
"""One page about the Python module, from its docstrings: python_reference.py OUT.html"""

import html
import inspect
import pathlib
import re
import sys

import halfstep


def shown(text):
    return re.sub(r"``(.*?)``", r"<code>\1</code>", html.escape(text or ""))


def documented(name, item, level):
    try:
        # Annotations without the quotes of annotations that are not evaluated.
        head = name + re.sub(r"(: |-> )'([^']*)'", r"\1\2", str(inspect.signature(item)))
    except (TypeError, ValueError):
        head = name
    return (f'<h{level} id="{name}"><code>{html.escape(head)}</code></h{level}>\n'
            f"<pre>{shown(inspect.getdoc(item))}</pre>\n")


def public(of):
    return sorted(name for name in getattr(of, "__all__", dir(of)) if not name.startswith("_"))


def main(out):
    body = f"<h1>import halfstep as hs</h1>\n<pre class=\"code\">{shown(halfstep.__doc__)}</pre>\n"
    for name in public(halfstep):
        item = getattr(halfstep, name)
        if inspect.ismodule(item):
            continue
        body += documented(f"hs.{name}", item, 2)
        if inspect.isclass(item):
            for member in sorted(vars(item)):
                if not member.startswith("_") and (callable(getattr(item, member))
                                                   or inspect.getdoc(getattr(item, member))):
                    body += documented(f"{name}.{member}", getattr(item, member), 3)
    body = re.sub(r"_halfstep\.", "", body)
    style = "body{font:16px/1.5 sans-serif;max-width:60em;margin:auto;padding:1em}" \
            "h2{font-size:1.1em;border-top:1px solid #888;padding-top:.5em}h3{font-size:1em}" \
            "pre{white-space:pre-wrap;font-family:inherit}.code{font-family:monospace}" \
            ":root{color-scheme:light dark}"
    pathlib.Path(out).write_text(
        f'<!DOCTYPE html><html lang="en"><head><meta charset="utf-8"><title>halfstep in Python'
        f'</title><style>{style}</style></head><body><p><a href="../index.html">halfstep</a></p>'
        f"{body}</body></html>\n", encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1])
