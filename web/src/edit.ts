// Changes of the text of a model by path: what is named changes, every other byte stays as the user wrote it.
import { findNodeAtLocation, parseTree, type JSONPath, type Node } from "jsonc-parser";

export type Edit = { from: number; to: number; insert: string };
export type Json = null | boolean | number | string | Json[] | { [key: string]: Json };

/** A number as short as can be. */
export const plain = (value: number): number => Number(value.toPrecision(12));

// An object of this length or less stands in one line.
const LINE = 110;

/** A value as the files of linkdyn are written: small objects and lists in one line. */
export const written = (value: Json, indent = "", step = "  "): string => {
  const flat = oneLine(value);
  if (flat.length + indent.length <= LINE || value === null || typeof value !== "object") return flat;
  const inner = indent + step;
  const parts = Array.isArray(value) ? value.map((own) => inner + written(own, inner, step))
    : Object.entries(value).map(([key, own]) => `${inner}${JSON.stringify(key)}: ${written(own, inner, step)}`);
  const [open, close] = Array.isArray(value) ? "[]" : "{}";
  return `${open}\n${parts.join(",\n")}\n${indent}${close}`;
};
const oneLine = (value: Json): string => {
  if (Array.isArray(value)) return `[${value.map(oneLine).join(", ")}]`;
  if (value === null || typeof value !== "object") return JSON.stringify(value);
  const parts = Object.entries(value).map(([key, own]) => `${JSON.stringify(key)}: ${oneLine(own)}`);
  return parts.length ? `{ ${parts.join(", ")} }` : "{}";
};

export const tree = (text: string): Node | undefined => parseTree(text);
export const at = (text: string, path: JSONPath): Node | undefined => {
  const root = tree(text);
  return root && findNodeAtLocation(root, path);
};

export const applied = (text: string, edits: Edit[]): string =>
  [...edits].sort((a, b) => b.from - a.from).reduce((made, { from, to, insert }) => made.slice(0, from) + insert + made.slice(to), text);

const lineOf = (text: string, offset: number): string => text.slice(text.lastIndexOf("\n", offset - 1) + 1, offset);
const indentOf = (text: string, offset: number): string => /^[ \t]*/.exec(text.slice(text.lastIndexOf("\n", offset - 1) + 1))?.[0] ?? "";
// How the file is indented: by its first indented line.
const stepOf = (text: string): string => /\n([ \t]+)\S/.exec(text)?.[1] ?? "  ";

/** Puts a value at a path: in place of what is there, or behind the last key of its object, whose style it takes. */
export const put = (text: string, path: JSONPath, value: Json): string => {
  const there = at(text, path);
  if (there) return applied(text, [{ from: there.offset, to: there.offset + there.length, insert: written(value, indentOf(text, there.offset), stepOf(text)) }]);
  const [key, parentPath] = [path[path.length - 1]!, path.slice(0, -1)];
  const parent = at(text, parentPath);
  if (!parent) return put(text, parentPath, typeof key === "number" ? [value] : { [key]: value });
  const head = typeof key === "number" ? "" : `${JSON.stringify(key)}: `, end = parent.offset + parent.length - 1;
  const last = parent.children?.[parent.children.length - 1];
  if (!last) {
    const indent = indentOf(text, parent.offset), inner = indent + stepOf(text), short = typeof key === "number" || path.length > 2;
    const insert = short ? (typeof key === "number" ? written(value) : ` ${head}${written(value, inner)} `) : `\n${inner}${head}${written(value, inner, stepOf(text))}\n${indent}`;
    return applied(text, [{ from: parent.offset + 1, to: end, insert }]);
  }
  const after = last.offset + last.length, before = lineOf(text, last.offset);
  // A key on a line of its own: so is the next one.
  const own = /^\s*$/.test(before) && text.slice(parent.offset, last.offset).includes("\n");
  const insert = own ? `,\n${before}${head}${written(value, before, stepOf(text))}` : `, ${head}${written(value, indentOf(text, last.offset), stepOf(text))}`;
  return applied(text, [{ from: after, to: after, insert }]);
};

/** Takes a key or an element away, with its comma. */
export const drop = (text: string, path: JSONPath): string => {
  const value = at(text, path);
  if (!value) return text;
  const node = value.parent?.type === "property" ? value.parent : value, all = node.parent?.children ?? [], k = all.indexOf(node);
  const [before, after] = [all[k - 1], all[k + 1]];
  const parent = node.parent!;
  if (before) return applied(text, [{ from: before.offset + before.length, to: node.offset + node.length, insert: "" }]);
  if (after) return applied(text, [{ from: node.offset, to: after.offset, insert: "" }]);
  return applied(text, [{ from: parent.offset + 1, to: parent.offset + parent.length - 1, insert: "" }]);
};

/** The least edit that makes one text of another. */
export const between = (before: string, after: string): Edit | null => {
  if (before === after) return null;
  const most = Math.min(before.length, after.length);
  let from = 0, end = 0;
  while (from < most && before[from] === after[from]) from++;
  while (end < most - from && before[before.length - 1 - end] === after[after.length - 1 - end]) end++;
  return { from, to: before.length - end, insert: after.slice(from, after.length - end) };
};

/** The model as it is written, or nothing where the text is no JSON. */
export const read = (text: string): Record<string, any> | null => {
  try { const made = JSON.parse(text); return made && typeof made === "object" && !Array.isArray(made) ? made : null; } catch { return null; }
};
