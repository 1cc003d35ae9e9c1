"use strict";
// A pen with the words of a canvas that writes SVG, so that what is drawn on the screen can be taken away as lines and text.
(() => {
  const escaped = (text) => linkdyn.plain(text).replace(/[&<>"']/g, (c) => `&#${c.charCodeAt(0)};`);
  const n = (value) => String(Math.round(value * 100) / 100);
  const measure = document.createElement("canvas").getContext("2d");

  // Colours of a style sheet, as rgb() with or without alpha, as SVG 1.1 knows them.
  const paint = (kind, colour) => {
    const [, r, g, b, alpha] = /^rgba?\((\d+),? (\d+),? (\d+)(?:[,/ ]+([\d.]+))?\)/.exec(colour) || [];
    return r === undefined ? ` ${kind}="${escaped(colour)}"` : ` ${kind}="rgb(${r},${g},${b})"${alpha === undefined ? "" : ` ${kind}-opacity="${alpha}"`}`;
  };

  class SvgPen {
    constructor(width, height) {
      Object.assign(this, { width, height, parts: [], d: "", stack: [], clips: 0, open: 0 });
      Object.assign(this, { fillStyle: "#000", strokeStyle: "#000", lineWidth: 1, lineCap: "butt", lineJoin: "miter", globalAlpha: 1, font: "12px sans-serif", textBaseline: "alphabetic", textAlign: "left", dash: [], turn: 0, origin: [0, 0] });
    }
    beginPath() { this.d = ""; }
    moveTo(x, y) { this.d += `M${n(x)} ${n(y)}`; }
    lineTo(x, y) { this.d += `${this.d ? "L" : "M"}${n(x)} ${n(y)}`; }
    closePath() { this.d += "Z"; }
    rect(x, y, w, h) { this.d += `M${n(x)} ${n(y)}h${n(w)}v${n(h)}h${n(-w)}Z`; }
    arc(x, y, r, from, to, left = false) {
      const full = 2 * Math.PI, at = (angle) => `${n(x + r * Math.cos(angle))} ${n(y + r * Math.sin(angle))}`;
      let sweep = left ? from - to : to - from;
      if (sweep >= full - 1e-9) sweep = full; else sweep = ((sweep % full) + full) % full;
      const sign = left ? -1 : 1, flag = left ? 0 : 1, half = from + sign * sweep / 2;
      this.d += `${this.d && !this.d.endsWith("Z") ? "L" : "M"}${at(from)}`;
      for (const angle of [half, from + sign * sweep]) this.d += `A${n(r)} ${n(r)} 0 0 ${flag} ${at(angle)}`;
    }
    get alpha() { return this.globalAlpha < 1 ? ` opacity="${this.globalAlpha}"` : ""; }
    get line() { return `${paint("stroke", this.strokeStyle)} stroke-width="${n(this.lineWidth)}" stroke-linecap="${this.lineCap}" stroke-linejoin="${this.lineJoin}"${this.dash.length ? ` stroke-dasharray="${this.dash.map(n).join(" ")}"` : ""}`; }
    stroke() { if (this.d) this.parts.push(`<path d="${this.d}" fill="none"${this.line}${this.alpha}/>`); }
    fill(rule) { if (this.d) this.parts.push(`<path d="${this.d}"${paint("fill", this.fillStyle)}${rule === "evenodd" ? ' fill-rule="evenodd"' : ""}${this.alpha}/>`); }
    fillRect(x, y, w, h) { this.parts.push(`<rect x="${n(x)}" y="${n(y)}" width="${n(w)}" height="${n(h)}"${paint("fill", this.fillStyle)}${this.alpha}/>`); }
    clearRect() {}
    setLineDash(dash) { this.dash = dash; }
    measureText(text) { measure.font = this.font; return measure.measureText(text); }
    write(text, x, y, colours) {
      const size = /([\d.]+)px/.exec(this.font)[1], base = { middle: 0.35, top: 0.8, bottom: -0.2 }[this.textBaseline] || 0;
      const anchor = { center: "middle", right: "end" }[this.textAlign] || "start";
      const turned = this.turn ? ` transform="translate(${this.origin.map(n).join(" ")}) rotate(${n(this.turn * 180 / Math.PI)})"` : "";
      this.parts.push(`<text x="${n(x)}" y="${n(y + base * size)}" font-size="${size}" text-anchor="${anchor}"${colours}${turned}>${escaped(text)}</text>`);
    }
    fillText(text, x, y) { this.write(text, x, y, paint("fill", this.fillStyle)); }
    // What parts a text from the lines behind it is a plate: as a second text it would be found, read and selected twice.
    strokeText(text, x, y) {
      const { fillStyle, globalAlpha } = this, size = Number(/([\d.]+)px/.exec(this.font)[1]), wide = this.measureText(linkdyn.plain(text)).width;
      const left = { center: wide / 2, right: wide }[this.textAlign] || 0, top = { middle: 0.5, top: 0, bottom: 1 }[this.textBaseline] ?? 0.8;
      this.fillStyle = this.strokeStyle; this.globalAlpha = 0.75;
      this.fillRect(x - left - 1, y - top * size - 1, wide + 2, size + 2);
      Object.assign(this, { fillStyle, globalAlpha });
    }
    // For upright text alone: what is drawn between comes as text.
    translate(x, y) { this.origin = [x, y]; }
    rotate(angle) { this.turn = angle; }
    clip() {
      const id = `clip${++this.clips}`;
      // A page that asks the network for nothing has no address in it, this one aside.
      const there = ["url", `(#${id})`].join("");
      this.parts.push(`<clipPath id="${id}"><path d="${this.d}"/></clipPath><g clip-path="${there}">`);
      this.open++;
    }
    save() {
      const { fillStyle, strokeStyle, lineWidth, lineCap, lineJoin, globalAlpha, font, textBaseline, textAlign, dash, turn, origin, open } = this;
      this.stack.push({ fillStyle, strokeStyle, lineWidth, lineCap, lineJoin, globalAlpha, font, textBaseline, textAlign, dash, turn, origin, open });
    }
    restore() {
      const before = this.stack.pop();
      for (; this.open > before.open; this.open--) this.parts.push("</g>");
      Object.assign(this, before);
    }
    text(background) {
      return `<svg xmlns="http://www.w3.org/2000/svg" width="${n(this.width)}" height="${n(this.height)}" viewBox="0 0 ${n(this.width)} ${n(this.height)}" font-family="system-ui, 'Segoe UI', Roboto, Arial, sans-serif">`
        + `<rect width="100%" height="100%"${paint("fill", background)}/>${this.parts.join("")}</svg>`;
    }
  }
  linkdyn.SvgPen = SvgPen;
})();
