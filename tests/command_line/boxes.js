// All texts of a page, in the document, in its pictures and on its canvases: which cover each other, stand outside, or on a curve.
(async () => {
  const wait = (time) => new Promise((done) => setTimeout(done, time));
  window.requestAnimationFrame = (draw) => setTimeout(() => draw(performance.now()), 16);
  const faults = [], fault = (...words) => { if (faults.length < 20) faults.push(words.join(" ")); };
  const short = (text) => text.trim().replace(/\s+/g, " ").slice(0, 40);

  // What is written on a canvas since it was cleared, in its own pixels.
  const written = new Map(), proto = CanvasRenderingContext2D.prototype, { fillText, clearRect } = proto;
  proto.clearRect = function (x, y, wide, tall) {
    const { a, d } = this.getTransform();
    if (wide * a > 0.9 * this.canvas.width && tall * d > 0.9 * this.canvas.height) written.delete(this.canvas);
    return clearRect.call(this, x, y, wide, tall);
  };
  for (const side of ["width", "height"]) {
    const own = Object.getOwnPropertyDescriptor(HTMLCanvasElement.prototype, side);
    Object.defineProperty(HTMLCanvasElement.prototype, side, { ...own, set(value) { written.delete(this); own.set.call(this, value); } });
  }
  proto.fillText = function (text, x, y, most) {
    const size = this.measureText(text), wide = Math.min(size.width, most ?? Infinity), part = size.width ? wide / size.width : 1;
    const corners = [-size.actualBoundingBoxLeft, size.actualBoundingBoxRight].flatMap((dx) => [-size.actualBoundingBoxAscent, size.actualBoundingBoxDescent]
      .map((dy) => this.getTransform().transformPoint(new DOMPoint(x + dx * part, y + dy))));
    if (String(text).trim()) written.set(this.canvas, [...written.get(this.canvas) ?? [], { text: short(String(text)), corners }]);
    return most === undefined ? fillText.call(this, text, x, y) : fillText.call(this, text, x, y, most);
  };

  await wait(400);
  const { plots, cards } = typeof linkdyn === "undefined" ? {} : linkdyn;
  // Plots below the first screen come when there is time.
  while (plots?.list?.some(({ u }) => !u)) await wait(50);
  // Another colour draws every canvas anew.
  for (let k = 0; k < 2; k++) { document.getElementById("theme")?.click(); await wait(400); }

  const shown = (node) => node.checkVisibility({ visibilityProperty: true, opacityProperty: true });
  // The part of a box that is not cut off by what it stands in; none of what may be scrolled to, or floats above the page.
  const seen = (node, { left, top, right, bottom }) => {
    for (; node && node !== document.body; node = node.parentElement) {
      const { overflowX, overflowY, position } = getComputedStyle(node);
      if (position === "fixed") return null;
      if (overflowX === "visible" && overflowY === "visible" || node instanceof SVGElement && node.tagName !== "svg") continue;
      const clip = node.getBoundingClientRect();
      [left, top] = [Math.max(left, clip.left), Math.max(top, clip.top)];
      [right, bottom] = [Math.min(right, clip.right), Math.min(bottom, clip.bottom)];
    }
    return right - left > 1 && bottom - top > 1 ? { left, top, right, bottom } : null;
  };

  const texts = [];
  const walk = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (walk.nextNode()) {
    const node = walk.currentNode, owner = node.parentElement;
    if (!node.data.trim() || owner.closest("script, style, noscript, option, #answer") || !shown(owner)) continue;
    const range = document.createRange();
    range.selectNodeContents(node);
    for (const box of range.getClientRects()) {
      const found = seen(owner, box);
      if (found) texts.push({ ...found, text: short(node.data), owner: node });
    }
  }
  const onCanvas = [...written].filter(([canvas]) => canvas.isConnected && shown(canvas) && canvas.clientWidth);
  for (const [canvas, list] of onCanvas) {
    const outer = canvas.getBoundingClientRect(), part = outer.width / canvas.width;
    for (const { text, corners } of list) {
      const [xs, ys] = ["x", "y"].map((axis) => corners.map((corner) => corner[axis] * part));
      const box = { left: outer.left + Math.min(...xs), right: outer.left + Math.max(...xs), top: outer.top + Math.min(...ys), bottom: outer.top + Math.max(...ys) };
      if (box.left < outer.left - 1.5 || box.right > outer.right + 1.5 || box.top < outer.top - 1.5 || box.bottom > outer.bottom + 1.5) fault("cut off:", text);
      const found = seen(canvas, box);
      if (found) texts.push({ ...found, text, owner: canvas });
    }
  }

  const wide = document.documentElement.scrollWidth - innerWidth;
  if (wide > 0) fault("scrolls sideways by", wide);
  for (const { left, right, text } of texts) if (left < -0.5 || right > innerWidth + 0.5) fault("outside:", text);
  // Boxes of lines overlap a little where lines are close; texts that stand in each other do so by more.
  const meet = (a, b) => Math.min(a.right, b.right) - Math.max(a.left, b.left) > 1.5 && Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > 3;
  texts.sort((a, b) => a.top - b.top);
  texts.forEach((a, k) => {
    for (let other = k + 1; other < texts.length && texts[other].top < a.bottom; other++) {
      const b = texts[other];
      // A text that is cut short has a box of its whole, too.
      if ((a.owner !== b.owner || a.owner instanceof HTMLCanvasElement) && meet(a, b)) fault("over each other:", a.text, "/", b.text);
    }
  });

  // Labels of plots, and the straight pieces of the curves that they stand on.
  const crosses = ({ x, y, wide, tall }, [a, b], [c, d]) => {
    let [from, to] = [0, 1];
    for (const [start, step, low, high] of [[a, c - a, x, x + wide], [b, d - b, y, y + tall]]) {
      if (step === 0) { if (start < low || start > high) return false; continue; }
      const ends = [(low - start) / step, (high - start) / step];
      [from, to] = [Math.max(from, Math.min(...ends)), Math.min(to, Math.max(...ends))];
    }
    return from < to;
  };
  let labels = 0;
  for (const { u, labels: own } of [...plots?.list ?? [], ...(cards?.list ?? []).flatMap(({ plots }) => plots)]) for (const label of own) {
    labels++;
    const inner = { x: label.x + 2, y: label.y + 2, wide: label.wide - 4, tall: label.tall - 4 };
    const xs = u.data[0].map((value) => u.valToPos(value, "x", true));
    const on = u.series.slice(1).some(({ scale }, k) => {
      // A line goes on over rows that a curve does not have.
      const known = xs.map((x, row) => [x, u.data[k + 1][row]]).filter(([, value]) => value !== undefined)
        .map(([x, value]) => Number.isFinite(value) ? [x, u.valToPos(value, scale, true)] : null);
      return known.some((place, row) => row && place && known[row - 1] && crosses(inner, known[row - 1], place));
    });
    if (on) fault("on a curve:", label.text);
  }

  // What the cursor finds, wherever it is.
  const tip = document.getElementById("tip");
  let tips = 0;
  for (const node of tip ? document.querySelectorAll("#canvas, .u-over") : []) {
    const { left, top, width, height } = node.getBoundingClientRect();
    for (let k = 0; k < 25; k++) {
      const [x, y] = [left + width * (k % 5 + 0.5) / 5, top + height * (Math.floor(k / 5) + 0.5) / 5];
      if (y < 0 || y > innerHeight) continue;
      node.dispatchEvent(new PointerEvent("pointermove", { clientX: x, clientY: y, pointerType: "mouse", bubbles: true }));
      if (tip.hidden) continue;
      tips++;
      const box = tip.getBoundingClientRect();
      if (box.left < 0 || box.top < 0 || box.right > innerWidth || box.bottom > innerHeight) fault("tip outside:", tip.textContent);
    }
  }
  answer({ faults, texts: texts.length, canvases: onCanvas.length, labels, tips });
})();
