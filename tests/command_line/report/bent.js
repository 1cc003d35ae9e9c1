// How far down the link reaches at an instant, enlarged and as it is, and what the page says about it.
(async () => {
  await new Promise((done) => setTimeout(done, 300));
  const { stage, drawing, shapes, mechanism, player, SvgPen } = linkdyn, row = 20, scale = 1000;
  player.seek(row);
  const picture = () => {
    const pen = new SvgPen(scale, scale), to = ([x, y]) => [scale * x, -scale * y];
    drawing.draw(pen, { to, scale, bar: 0.001, row, colours: drawing.palette(), show: {} });
    const places = pen.parts.flatMap((part) => [...part.matchAll(/[ML]([-\d.]+) ([-\d.]+)/g)]);
    const lowest = Math.max(...places.filter(([, x]) => x > scale / 2).map(([, , y]) => Number(y))) / scale;
    const words = new SvgPen(scale, scale);
    stage.pose(words);
    return { lowest, text: /deflection × [\d.]+/.exec(words.text("#fff"))?.[0] };
  };
  const enlarged = picture(), choice = document.querySelector("select[aria-label='Scale of deflections']");
  choice.value = "1";
  choice.dispatchEvent(new Event("change"));
  answer({ place: shapes.place(mechanism.points[0], row)[1], enlarged, true: picture() });
})();
