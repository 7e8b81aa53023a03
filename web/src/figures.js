// What the page does, in numbers, for whoever measures it: `skein.figures()` in the console.

const figures = {frames: 0, early: 0, drawCalls: 0, mostDrawCalls: 0};
const more = [];

/** @param info  of the renderer, after a picture was drawn. @param early  the picture before was not finished yet */
export function countFrame({render}, early) {
  ++figures.frames;
  if (early) ++figures.early;
  figures.drawCalls = render.calls;
  figures.mostDrawCalls = Math.max(figures.mostDrawCalls, render.calls);
}

/** @param tell  returns an object with further figures. */
export const addFigures = (tell) => more.push(tell);

globalThis.skein = {figures: () => Object.assign({...figures}, ...more.map((tell) => tell()))};
