// Looks at the page of a comparison and uses its switches.
(async () => {
  const wait = (time) => new Promise((done) => setTimeout(done, time));
  const box = (node) => node.getBoundingClientRect();
  const { cards, ran, runs, columns, models, given, times } = linkdyn;
  await wait(300);
  const first = cards.list[0], told = {
    width: innerWidth, height: innerHeight, scroll_width: document.documentElement.scrollWidth,
    first_bottom: box(first.plots[0].u.over).bottom, first_tall: box(first.plots[0].u.over).height,
    requests: performance.getEntriesByType("resource").map(({ name }) => name),
    columns: [...document.querySelectorAll(".card h2 .text")].map((node) => node.textContent),
    models: runs.map(({ name }) => name),
    switches: [...document.querySelectorAll("#runs label .text")].map((node) => node.textContent),
  };
  const force = columns.findIndex(({ name }) => name.endsWith(".force")), contact = ran.find(({ name }) => name === "contact");
  told.largest_force = Math.max(...contact.values[force]);
  told.rms_force = contact.differences[force][3];

  // Texts of the head, of the bar and of readouts that cover each other.
  const nodes = [...document.querySelectorAll("#name, #line, .run .text, #view label, .card h2 > *, .value > .text, .value > .number")].filter((node) => box(node).width > 0);
  told.texts_covered = [];
  nodes.forEach((one, k) => nodes.slice(k + 1).forEach((other) => {
    const [a, b] = [box(one), box(other)];
    if (a.left < b.right - 1 && b.left < a.right - 1 && a.top < b.bottom - 2 && b.top < a.bottom - 2) told.texts_covered.push([one.textContent, other.textContent]);
  }));

  // Texts of a card that touch its frame.
  told.texts_outside = [...document.querySelectorAll(".value > .text, .value > .number, .card h2 > *")]
    .filter((node) => box(node).width > 0 && box(node).right > box(node.closest(".card")).right - 4).map((node) => node.textContent);

  // Peaks of each plot that lie beyond its axis, and those that the marks tell of; labels that cover each other.
  told.peaks = cards.list.map(({ plots }) => {
    const beyond = [], said = [];
    let covered = 0;
    for (const { u, list, labels, found } of plots) {
      const { min, max } = u.scales.y;
      for (const { run, values } of list) for (const out of [(value) => value > max, (value) => value < min]) if (values.some((value) => Number.isFinite(value) && out(value))) beyond.push(run.name);
      said.push(...found.map(({ run }) => run));
      // Nor do they touch the frame beside them: 4 px are between.
      const { left, width } = u.bbox, room = 4 * devicePixelRatio;
      covered += labels.filter(({ x, wide }) => x < left + room || x + wide > left + width - room).length;
      labels.forEach((a, k) => labels.slice(k + 1).forEach((b) => { if (a.x < b.x + b.wide && b.x < a.x + a.wide && a.y < b.y + b.tall && b.y < a.y + a.tall) covered++; }));
    }
    return { beyond: beyond.sort(), told: said.sort(), covered };
  });

  // Pixels of the contact model's colour, in the first card and at the foot of it.
  const [red, green, blue] = [1, 3, 5].map((at) => parseInt(models.stroke(contact).slice(at, at + 2), 16));
  const count = ({ u }, low = 0) => {
    const canvas = Object.assign(document.createElement("canvas"), { width: u.ctx.canvas.width, height: u.ctx.canvas.height });
    const pen = canvas.getContext("2d", { willReadFrequently: true });
    pen.drawImage(u.ctx.canvas, 0, 0);
    const { data } = pen.getImageData(0, 0, canvas.width, canvas.height);
    let pixels = 0;
    for (let k = 4 * canvas.width * Math.round(low); k < data.length; k += 4) if (Math.abs(data[k] - red) + Math.abs(data[k + 1] - green) + Math.abs(data[k + 2] - blue) < 12 && data[k + 3] > 250) pixels++;
    return pixels;
  };
  const foot = ({ u }) => u.bbox.top + u.bbox.height - 20 * devicePixelRatio;
  const tick = [...document.querySelectorAll("#runs label")].find((label) => label.textContent.includes("contact")).querySelector("input");
  const look = async (state) => {
    await wait(100);
    [told[`upper_${state}`], told[`lower_${state}`]] = first.plots.map((plot) => count(plot));
    told[`marks_${state}`] = count(first.plots[0], foot(first.plots[0]));
  };
  await look("on");
  tick.click();
  await look("off");
  tick.click();
  await look("again");

  // A cursor on one plot tells the values of all.
  const { over } = first.plots[0].u, place = box(over);
  const before = cards.list.map(({ values }) => values.textContent);
  over.dispatchEvent(new PointerEvent("pointermove", { clientX: place.left + place.width * 0.37, clientY: place.top + 20, pointerType: "mouse", bubbles: true }));
  const row = cards.row;
  told.hovered = row !== null && Math.abs((times[row] - times[0]) / (times[times.length - 1] - times[0]) - 0.37) < 0.05
    && cards.list.every(({ values }, k) => values.textContent !== before[k]) && given.runs.length === runs.length;
  answer(told);
})();
