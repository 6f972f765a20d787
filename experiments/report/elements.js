// Parts of a page. Everything is set as text.

export function element(name, { text, className, title } = {}, ...children) {
  const made = document.createElement(name);
  if (text !== undefined) made.textContent = text;
  if (className) made.className = className;
  if (title) made.title = title;
  made.append(...children);
  return made;
}

/** A table that scrolls sideways by itself where the page is narrow. Cells: texts or elements. */
export function table(header, rows) {
  const head = element("tr", {}, ...header.map((text) => element(text ? "th" : "td", { text })));
  const body = rows.map((cells) =>
    element("tr", {}, ...cells.map((cell) =>
      cell instanceof Node ? element("td", {}, cell) : element("td", { text: cell }))),
  );
  const scroll = element("div", { className: "scroll" },
    element("table", {}, element("thead", {}, head), element("tbody", {}, ...body)));
  scroll.tabIndex = 0; // scrolled by keys, too
  return scroll;
}

/** The colour and the name of a line. */
export function lineKey(colour, label, name = "span") {
  const key = element(name, { className: "key" });
  const line = element("i", { className: "line" });
  line.style.background = colour;
  key.append(line, element("span", { text: label }));
  return key;
}
