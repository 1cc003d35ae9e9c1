"use strict";
// Two systems of units, and numbers as text.
(() => {
  const engineering = {
    "m": [1e3, "mm"], "m/s": [1e3, "mm/s"], "rad": [180 / Math.PI, "°"], "rad/s": [30 / Math.PI, "rpm"],
    "Pa": [1e-6, "MPa"], "m/rad": [1e3, "mm/rad"], "rad/m": [1e-3, "rad/mm"], "N/(N*m)": [1e-3, "N/N·mm"], "N*m/N": [1e3, "N·mm/N"],
  };
  // Large values of these are written in thousands.
  const thousands = { "N": "kN", "N*m": "kN·m", "W": "kW", "J": "kJ" };
  const pretty = (unit) => unit === "1" ? "–" : unit.replaceAll("*", "·").replace("^2", "²");
  const listeners = [];
  let system = "engineering";

  // Of a unit of the results: factor from SI, and what to write.
  const of = (unit) => {
    const found = system === "engineering" && Object.hasOwn(engineering, unit) ? engineering[unit] : [1, pretty(unit)];
    return { factor: found[0], label: found[1] };
  };

  // A number of so many digits; nothing where there is none.
  const number = (value, digits = 5) => {
    if (value === null || value === undefined || !Number.isFinite(value)) return "–";
    if (value === 0) return "0";
    const size = Math.abs(value);
    // Numbers below a million are written out, with no more digits than are known.
    const text = size >= 1e6 || size < 1e-3 ? value.toExponential(digits - 1) : String(Number(value.toPrecision(digits)));
    const [mantissa, exponent] = text.split("e");
    const short = mantissa.includes(".") ? mantissa.replace(/\.?0+$/, "") : mantissa;
    return (exponent === undefined ? short : `${short}e${Number(exponent)}`).replaceAll("-", "−");
  };

  // A value of a column with its unit; beside an axis in that of the axis, which does not go over to thousands.
  const quantity = (value, unit, digits = 5, isBesideAxis = false) => {
    if (!Number.isFinite(value)) return "–";
    // Round-off of lengths and angles is nothing.
    if ((unit === "m" || unit === "rad") && Math.abs(value) < 1e-12) value = 0;
    const { factor, label } = of(unit);
    if (!isBesideAxis && system === "engineering" && Object.hasOwn(thousands, unit) && Math.abs(value) >= 9999.5) return `${number(value / 1e3, digits)} ${thousands[unit]}`;
    return number(value * factor, digits) + (label === "–" ? "" : label === "°" ? "°" : " " + label);
  };

  // A round length, as short as can be.
  const length = (metres) => {
    const known = system === "engineering" ? [[1, "m"], [1e-3, "mm"], [1e-6, "µm"]] : [[1, "m"]];
    // Round-off of a metre is still a metre.
    const [unit, label] = known.find(([unit]) => metres > unit * 0.999) || known[known.length - 1];
    return `${number(metres / unit, 6)} ${label}`;
  };

  linkdyn.units = {
    of, number, quantity, length,
    get system() { return system; },
    set system(name) { system = name; listeners.forEach((listen) => listen()); },
    onChange: (listen) => listeners.push(listen),
  };
})();
