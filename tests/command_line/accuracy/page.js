// Looks at the page of accuracy and uses what can be pressed.
(async () => {
  const wait = (time) => new Promise((done) => setTimeout(done, time));
  const box = (node) => node.getBoundingClientRect();
  const id = (name) => document.getElementById(name);
  const { choice, outputs, bandPlot, worst, bands, sources, file } = linkdyn;
  await wait(300);
  const tiles = (node) => Object.fromEntries([...node.querySelectorAll(".tile")].map(({ children: [label, text] }) => [label.textContent, text.textContent]));
  const rows = () => { const texts = [...document.querySelectorAll(".shares > :not(.bar)")].map((node) => node.textContent).slice(5); return Array.from({ length: texts.length / 4 }, (_, k) => texts.slice(4 * k, 4 * k + 4)); };
  const bars = () => [...document.querySelectorAll(".bar i")].map(({ style }) => [parseFloat(style.left), parseFloat(style.width)]);
  const told = {
    width: innerWidth, scroll_width: document.documentElement.scrollWidth, height: innerHeight,
    requests: performance.getEntriesByType("resource").map(({ name }) => name),
    plot_bottom: bandPlot.u ? box(bandPlot.u.over).bottom : null, plot_tall: bandPlot.u ? box(bandPlot.u.over).height : null,
    outputs: [...document.querySelectorAll("#outputs > *")].map((node) => ({ name: node.querySelector("strong").textContent, badge: node.querySelector(".badge")?.textContent ?? null, tiles: tiles(node) })),
    time: choice.at("time"), shares: rows(), bars: bars(), peaks: bandPlot.peaks, note: id("band_note").textContent,
    open: outputs.map((output) => bands.runs(output).filter(([, , certified]) => !certified).map(([from, to]) => to - from + 1)),
    details: outputs.map(({ details }) => details.length), foot: id("foot").textContent,
    sides: [...document.querySelectorAll("#sides button")].map((node) => node.textContent), factor: worst.factor, factor_told: id("factor_is").textContent,
    needed: { hidden: id("needed").hidden, note: id("needed_note").textContent, ends: [...document.querySelectorAll("#needed_plot circle")].map((dot) => Number(dot.getAttribute("cx"))),
      curves: [...document.querySelectorAll("#needed_plot polyline")].map((line) => line.getAttribute("points").split(" ").map((point) => point.split(",").map(Number))) },
    names_broken: [...document.querySelectorAll(".shares > .text")].map((node) => node.querySelectorAll("wbr").length),
    sliders: [...document.querySelectorAll(".slider > .text")].map((node) => node.textContent),
  };
  told.texts_outside = [...document.querySelectorAll(".card :is(span, p, button), .output span")].filter((node) => box(node).width > 0 && box(node).right > innerWidth - 6).map((node) => node.textContent);

  const pixels = (canvas, test, part) => {
    const copy = Object.assign(document.createElement("canvas"), { width: canvas.width, height: canvas.height });
    const pen = copy.getContext("2d", { willReadFrequently: true });
    pen.drawImage(canvas, 0, 0);
    const [from, to] = (part || [0, 1]).map((part) => Math.round(part * copy.width));
    const { data } = pen.getImageData(from, 0, Math.max(to - from, 1), copy.height);
    let count = 0, sum = 0;
    for (let k = 0; k < data.length; k += 4) { sum = (sum * 31 + data[k] + 7 * data[k + 1] + 13 * data[k + 2]) % 1000000007; if (test(data[k], data[k + 1], data[k + 2])) count++; }
    return { count, sum };
  };
  const drawing = () => pixels(id("canvas"), () => false).sum;
  const band = () => pixels(bandPlot.u.ctx.canvas, () => false).sum;

  // Where the stroke is clicked there is the pose, with its contributions and its configuration.
  if (bandPlot.u) {
    const before = { drawing: drawing(), shares: JSON.stringify(rows()), head: document.querySelector("#outputs > *").textContent };
    const { over } = bandPlot.u, place = box(over);
    over.dispatchEvent(new PointerEvent("pointerdown", { clientX: place.left + place.width * 0.25, clientY: place.top + 20, pointerType: "pen", bubbles: true }));
    await wait(50);
    const { values } = choice.output.x, part = (values[choice.detail.row] - values[0]) / (values[values.length - 1] - values[0]);
    told.clicked = Math.abs(part - 0.25);
    told.follows = { drawing: drawing() !== before.drawing, shares: JSON.stringify(rows()) !== before.shares, head: document.querySelector("#outputs > *").textContent !== before.head };
    told.clicked_time = choice.at("time");
    told.clicked_shares = rows();
    id("pose").value = 0;
    id("pose").dispatchEvent(new Event("input"));
    told.first_pose = choice.detail.row;
  }

  // A larger factor and the other side change the drawing.
  const drawn = drawing();
  id("factor").value = 1000;
  id("factor").dispatchEvent(new Event("input"));
  told.larger = { factor: worst.factor, drawing: drawing() !== drawn };
  id("fit").click();
  told.fitted = { factor: worst.factor, drawing: drawing() === drawn };
  document.querySelector("#sides button").click();
  told.other_side = { side: choice.side, drawing: drawing() !== drawn };

  // A slider moves the output, and the worst along with it; the reset takes it back.
  const slider = document.querySelector("#sliders input");
  if (slider) {
    const source = sources.findIndex(({ slider }) => slider), input = slider, plot = bandPlot.u && band(), nominal = id("moved").textContent;
    input.value = input.max;
    input.dispatchEvent(new Event("input"));
    await wait(50);
    told.moved = { time: choice.at("time"), shift: choice.shift(choice.detail), delta: choice.delta[source], text: id("moved").textContent, plot: bandPlot.u && band() !== plot,
      expected: file.signed(choice.shift(choice.detail), choice.output.unit), level: id("what_level").textContent, corner: choice.corner };
    // All at their worst: the value and the drawing are the worst found.
    const [low, high] = document.querySelectorAll("#corners button"), at = () => ({ corner: choice.corner, side: choice.side, level: id("what_level").textContent, text: id("moved").textContent, inputs: [...document.querySelectorAll("#sliders input")].map(({ value }) => Number(value)) });
    low.click();
    told.lowest = { ...at(), expected: file.signed(choice.at("found_low"), choice.output.unit) };
    high.click();
    told.highest = { ...at(), expected: file.signed(choice.at("found_high"), choice.output.unit) };
    input.value = input.max / 2;
    input.dispatchEvent(new Event("input"));
    told.between = { ...at(), note: id("worst_note").textContent };
    id("reset").click();
    await wait(50);
    told.reset = id("moved").textContent === nominal && Number(input.value) === 0 && !choice.isMoved && (!bandPlot.u || band() === plot);
  }
  if (outputs.length > 1) {
    document.querySelectorAll("#outputs > *")[2].click();
    await wait(50);
    told.third = { name: choice.output.name, band_hidden: id("band").hidden, shares: rows().length };
  }
  answer(told);
})();
