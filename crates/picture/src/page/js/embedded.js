"use strict";
// The one global: every file adds its part. What a page shows comes from two script elements, JSON and base64.
const linkdyn = {};
(() => {
  const id = (name) => document.getElementById(name);
  const given = JSON.parse(id("data").textContent);

  // Browsers before 2025 have no decoder of their own for bytes.
  const decoded = (base64) => {
    if (Uint8Array.fromBase64) return Uint8Array.fromBase64(base64);
    const binary = atob(base64), bytes = new Uint8Array(binary.length);
    for (let k = 0; k < binary.length; k++) bytes[k] = binary.charCodeAt(k);
    return bytes;
  };
  // Little-endian floats; an empty cell is NaN.
  const floatsOf = ({ bytes }, text) => new (bytes === 8 ? Float64Array : Float32Array)(decoded(text.trim()).buffer);
  // A page around this one that has the numbers hands them over as they are.
  const floats = frameElement?.handed ?? floatsOf(given, id("values").textContent);

  // Control characters and those that change the direction of writing, spelt out.
  const plain = (any) => String(any).replace(/[\u0000-\u001f\u007f-\u009f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069]/g,
    (c) => "\\u{" + c.codePointAt(0).toString(16) + "}");

  // An element with text; names come into the page nowhere else.
  const filled = (made, { text, className, on, ...rest }, children) => {
    if (text !== undefined) made.textContent = plain(text);
    if (className) made.setAttribute("class", className);
    for (const [event, act] of Object.entries(on || {})) made.addEventListener(event, act);
    for (const [key, value] of Object.entries(rest)) made.setAttribute(key, value);
    made.append(...children);
    return made;
  };
  const element = (tag, options = {}, ...children) => filled(document.createElement(tag), options, children);
  const svg = (tag, options = {}, ...children) => filled(document.createElementNS("http://www.w3.org/2000/svg", tag), options, children);
  // An icon that the page defines.
  const icon = (name) => svg("svg", { className: "icon" }, svg("use", { href: `#i-${name}` }));
  // A status in words.
  const words = (text) => text === "quasi_statics" ? "quasi-statics" : String(text).replaceAll("_", " ");

  Object.assign(linkdyn, { given, floats, floatsOf, plain, element, svg, icon, id, words, palette: given.palette, mechanism: given.mechanism });
  window.linkdyn = linkdyn;
})();
