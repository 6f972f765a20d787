// Tables of a run.
import { readFileSync } from "node:fs";

/** The rows of a CSV file as objects of texts. */
export const rowsOf = (path) => {
  const [head, ...lines] = readFileSync(path, "utf8").trim().split("\n").map((line) => line.split(","));
  return lines.map((cells) => Object.fromEntries(head.map((name, i) => [name, cells[i]])));
};
