// Elements and figures. Text from the run only ever becomes text.

const byId = (id) => document.getElementById(id);

/** Makes an element; children are elements or text. */
function element(tag, properties, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}

/** A number for people; a dash for what isn't available. */
function told(value, digits = 1, unit = "") {
  if (value === null || value === undefined) return "–";
  if (typeof value !== "number") return String(value);
  const text = value.toLocaleString("en", {
    minimumFractionDigits: digits, maximumFractionDigits: digits, useGrouping: value >= 10000,
  });
  const clean = /^-[0.]*$/.test(text) ? text.slice(1) : text;
  return clean.replace("-", "−") + (unit && " " + unit);
}

const toldPlace = (place) => (place ? `(${told(place[0], 2)}, ${told(place[1], 2)})` : "–");

/** A table; columns are [heading, whether of numbers], rows are lists of texts. */
function tableOf(caption, columns, rows, currentRow = -1) {
  const table = element("table", {});
  if (caption) table.append(element("caption", {}, caption));
  const kind = (column) => ({ className: columns[column][1] ? "number" : "" });
  const heads = columns.map(([name], column) => element("th", { scope: "col", ...kind(column) }, name));
  table.append(element("thead", {}, element("tr", {}, ...heads)));
  const lines = rows.map((row, index) => element(
    "tr",
    { className: index === currentRow ? "current" : "" },
    ...row.map((text, column) => element("td", kind(column), text)),
  ));
  table.append(element("tbody", {}, ...lines));
  return element("div", { className: "scroll" }, table);
}

/** A style's value, as it is in light or dark. */
const styled = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
