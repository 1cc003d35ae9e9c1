// Elements of the page; names reach it as text alone.
type Options = { text?: string; className?: string; on?: Record<string, (event: any) => void>; [attribute: string]: unknown };
export const element = <K extends keyof HTMLElementTagNameMap>(tag: K, { text, className, on, ...rest }: Options = {}, ...children: (Node | string)[]): HTMLElementTagNameMap[K] => {
  const made = document.createElement(tag);
  if (text !== undefined) made.textContent = text;
  if (className) made.className = className;
  for (const [event, act] of Object.entries(on ?? {})) made.addEventListener(event, act);
  for (const [key, value] of Object.entries(rest)) if (value !== undefined && value !== false) made.setAttribute(key, String(value));
  made.append(...children);
  return made;
};
export const id = <T extends HTMLElement = HTMLElement>(name: string): T => document.getElementById(name) as T;
export const drawn = (path: string): SVGElement => {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg"), line = document.createElementNS("http://www.w3.org/2000/svg", "path");
  svg.setAttribute("viewBox", "0 0 24 24"); svg.setAttribute("aria-hidden", "true");
  line.setAttribute("d", path);
  svg.append(line);
  return svg;
};
