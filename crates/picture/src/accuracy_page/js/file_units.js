"use strict";
// Numbers in the units of the file.
(() => {
  const { given } = linkdyn, { number } = linkdyn.units;
  const of = (unit) => {
    const [symbol, size] = Object.hasOwn(given.units, unit) ? given.units[unit] : [unit.replaceAll("*", "·"), 1];
    return { symbol, size };
  };
  const gap = (symbol) => symbol === "°" || symbol === "" ? symbol : ` ${symbol}`;
  // Round-off of lengths and angles is nothing.
  const clean = (si, unit) => (unit === "m" || unit === "rad") && Math.abs(si) < 1e-12 ? 0 : si;
  const value = (si, unit, digits = 5) => { const { symbol, size } = of(unit); return Number.isFinite(si) ? number(clean(si, unit) / size, digits) + gap(symbol) : "–"; };
  const signed = (si, unit, digits = 4) => Number.isFinite(si) ? (clean(si, unit) > 0 ? "+" : "") + value(si, unit, digits) : "–";
  // ±a, or −a / +b.
  const both = (low, high, unit, digits = 4) => {
    if (!Number.isFinite(low) && !Number.isFinite(high)) return null;
    const [below, above] = [value(-low, unit, digits), value(high, unit, digits)];
    return below === above ? `±${above}` : `${signed(low, unit, digits)} / ${signed(high, unit, digits)}`;
  };
  // Long names break at their dots.
  linkdyn.dotted = (name) => linkdyn.plain(name).split(/(?<=\.)/).flatMap((part, k) => k ? [document.createElement("wbr"), part] : [part]);
  linkdyn.file = { of, value, signed, both, number };
})();
