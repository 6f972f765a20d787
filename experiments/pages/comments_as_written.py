#!/usr/bin/python3
"""Doxygen's input filter: comments as this project means them. One argument, a header; prints it.

- A comment of several names in one declaration (`double begin, end;  ///< [s]`) is each one's.
- A comment behind a line ends with it: the next line's comment is the next declaration's.
- Destructors and defaulted comparisons or deleted functions say what they do by the language.

Lines keep their numbers.
"""

import re
import sys

BY_LANGUAGE = re.compile(
    r"\s*(friend )?(constexpr )?(friend )?(bool|auto) operator(==|<=>)\(.*= default;"
    r"|\s*(virtual )?~\w+\(\)( override)?( = default)?;|.*= delete;")
DECLARATION = re.compile(
    r"(\s*(?:const |static |constexpr )*[\w:]+(?:<.*>)?(?: \*|[*&])?) (\w[^()]*);\s*$")


def split(names):
    """At the commas that stand in no bracket."""
    parts, depth, begin = [], 0, 0
    for i, c in enumerate(names):
        depth += (c in "<({[") - (c in ">)}]")
        if c == "," and depth == 0:
            parts.append(names[begin:i].strip())
            begin = i + 1
    return parts + [names[begin:].strip()]


def main(path):
    above = ""  # the comment that stands on the lines before
    for line in open(path, encoding="utf-8"):
        line = line.rstrip("\n")
        code, behind, said = line.partition("///<")
        if not line.strip() or BY_LANGUAGE.match(line):
            above = ""
            print()
            continue
        if code.strip().startswith("///"):
            above += code.strip()[3:]
            print(line)
            continue
        declaration = DECLARATION.match(code)
        names = split(declaration[2]) if declaration else []
        if len(names) > 1 and (behind or above):
            kind, comment = declaration[1], f"/**< {(said or above).strip()} */"
            print(f"{kind} {names[0]};", comment if behind else "",
                  *(f"{kind.strip()} {name}; {comment}" for name in names[1:]))
        elif behind:
            print(f"{code}/**< {said.strip()} */")
        else:
            print(line)
        above = ""


if __name__ == "__main__":
    if sys.argv[1].endswith(".h"):
        main(sys.argv[1])
    else:
        sys.stdout.write(open(sys.argv[1], encoding="utf-8").read())
