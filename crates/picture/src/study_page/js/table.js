"use strict";
// The variants as a table: only the rows in view are in the page.
(() => {
  const { variables, variants, numbers, status, reason, units, choice, element, id } = linkdyn;
  const TALL = 27, SPARE = 6, ON_PAPER = 40;
  const scroller = id("rows"), body = id("rows_body");
  let order = Array.from(numbers, (_, row) => row), sorted = null, down = false, list = order, paper = false;

  const columns = [
    { label: "variant", value: (row) => numbers[row], text: (row) => String(numbers[row]), number: true },
    { label: "status", value: (row) => status[row], text: (row) => reason(row) ?? "completed" },
    ...variables.map((own) => ({ label: own.label, value: (row) => own.values[row], text: (row) => units.number(own.values[row], 7), number: true })),
  ];
  const heads = columns.map((column) => {
    const button = element("button", { type: "button", text: column.label, on: { click: () => sort(column) } });
    const head = element("th", { className: column.number ? "number" : "", scope: "col" }, button);
    id("rows_head").append(head);
    return [column, head, button];
  });

  const row_of = (row) => {
    const made = element("tr", { className: `${row === choice.row ? "chosen" : ""}${choice.mask?.[row] ? " within" : ""}`, "data-row": row });
    made.append(...columns.map((column, k) => element("td", { className: `${column.number ? "number" : "text"}${k === 1 && status[row] ? " bad" : ""}`, text: column.text(row), title: k === 1 ? column.text(row) : "" })));
    return made;
  };
  const space = (rows) => { const made = element("tr", { className: "space", "aria-hidden": "true" }); made.append(element("td", { colspan: columns.length })); made.firstChild.style.height = `${rows * TALL}px`; return made; };
  const draw = () => {
    const first = paper ? 0 : Math.max(0, Math.min(Math.floor(scroller.scrollTop / TALL) - SPARE, list.length - 1));
    const last = paper ? Math.min(ON_PAPER, list.length) : Math.min(list.length, first + Math.ceil((scroller.clientHeight || 300) / TALL) + 2 * SPARE);
    body.replaceChildren(...(first > 0 ? [space(first)] : []), ...list.slice(first, last).map(row_of), ...(last < list.length && !paper ? [space(list.length - last)] : []));
    id("rows_count").textContent = paper && list.length > ON_PAPER ? `the first ${ON_PAPER} of ${linkdyn.count(list.length)}` : linkdyn.count(list.length);
  };
  const fill = () => {
    list = id("only").checked && choice.mask ? order.filter((row) => choice.mask[row]) : order;
    draw();
  };
  // What has no value comes last, up or down.
  const sort = (column) => {
    down = sorted === column && !down;
    sorted = column;
    const sign = down ? -1 : 1;
    order = Array.from(numbers, (_, row) => row).sort((a, b) => {
      const [x, y] = [column.value(a), column.value(b)];
      if (Number.isNaN(x) || Number.isNaN(y)) return Number.isNaN(x) - Number.isNaN(y) || a - b;
      return sign * (x - y) || a - b;
    });
    heads.forEach(([own, head, button]) => {
      head.setAttribute("aria-sort", own !== sorted ? "none" : down ? "descending" : "ascending");
      button.textContent = own.label + (own !== sorted ? "" : down ? " ▾" : " ▴");
    });
    scroller.scrollTop = 0;
    fill();
  };
  scroller.addEventListener("scroll", draw, { passive: true });
  body.addEventListener("click", (event) => {
    const row = event.target.closest("tr")?.dataset.row;
    if (row !== undefined) choice.choose(Number(row));
  });
  scroller.addEventListener("keydown", (event) => {
    const by = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (!by) return;
    event.preventDefault();
    event.stopPropagation();
    const place = Math.min(Math.max(list.indexOf(choice.row) + by, 0), list.length - 1);
    if (place * TALL < scroller.scrollTop || (place + 2) * TALL > scroller.scrollTop + scroller.clientHeight) scroller.scrollTop = (place - 3) * TALL;
    if (list.length) choice.choose(list[place]);
  });
  id("only").addEventListener("change", () => { scroller.scrollTop = 0; fill(); });
  choice.onPaint(fill);
  new ResizeObserver(() => draw()).observe(scroller);
  linkdyn.table = { set paper(on) { paper = on; fill(); }, sort, columns };
})();
