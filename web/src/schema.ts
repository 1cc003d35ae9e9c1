// Completion of keys and words by the JSON Schema of the format.
import type { Completion, CompletionContext, CompletionResult } from "@codemirror/autocomplete";
import { getLocation, type JSONPath } from "jsonc-parser";

export type Schema = { [key: string]: any };

/** All schemas that hold at a path. */
const along = (root: Schema, path: JSONPath): Schema[] => {
  const opened = (schema: Schema | undefined, depth = 0): Schema[] => {
    if (!schema || typeof schema !== "object" || depth > 8) return [];
    if (schema.$ref) return opened(schema.$ref.split("/").slice(1).reduce((own: Schema, key: string) => own?.[key], root), depth + 1);
    return [schema, ...["anyOf", "oneOf", "allOf"].flatMap((key) => (schema[key] ?? []).flatMap((own: Schema) => opened(own, depth + 1)))];
  };
  return path.reduce((found: Schema[], key) => found.flatMap((own) => {
    const next = typeof key === "number" ? (own.prefixItems?.[key] ?? own.items) : (own.properties?.[key] ?? (typeof own.additionalProperties === "object" ? own.additionalProperties : undefined));
    return opened(next);
  }), opened(root));
};

const unique = (list: Completion[]): Completion[] => [...new Map(list.map((own) => [own.label, own])).values()];

export const completions = (schema: Schema) => (context: CompletionContext): CompletionResult | null => {
  const text = context.state.sliceDoc(), place = getLocation(text, context.pos);
  const word = context.matchBefore(/"?[\w/]*/), from = word ? word.from : context.pos;
  if (!context.explicit && (!word || word.from === word.to)) return null;
  const quoted = text[context.pos] === "\"" && text[from] === "\"" ? 1 : 0;
  if (place.isAtPropertyKey) {
    const keys = along(schema, place.path.slice(0, -1)).flatMap((own) => Object.entries<Schema>(own.properties ?? {}));
    const options = keys.map(([key, own]): Completion => ({ label: `"${key}"`, detail: "", ...(own.description ? { info: own.description } : {}), type: "property", apply: text.slice(from, context.pos + quoted).endsWith(":") ? `"${key}"` : `"${key}": ` }));
    return options.length ? { from, to: context.pos + quoted, options: unique(options) } : null;
  }
  const values = along(schema, place.path).flatMap((own) => own.enum ?? (own.const !== undefined ? [own.const] : own.type === "boolean" ? [true, false] : []));
  const options = values.map((value): Completion => ({ label: JSON.stringify(value), type: "enum" }));
  return options.length ? { from, to: context.pos + quoted, options: unique(options) } : null;
};
