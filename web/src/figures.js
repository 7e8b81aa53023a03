// Figures about the page's work, for measurements: `skein.figures()` in the browser's console.

const figures = {frames: 0, early: 0, drawCalls: 0, mostDrawCalls: 0};
const more = [];

/**
 * @param info  the renderer's, after a picture.
 * @param early  whether it began before the last picture was finished.
 */
export function countFrame({render}, early) {
  ++figures.frames;
  if (early) ++figures.early;
  figures.drawCalls = render.calls;
  figures.mostDrawCalls = Math.max(figures.mostDrawCalls, render.calls);
}

/** @param tell  function that returns an object with further figures. */
export const addFigures = (tell) => more.push(tell);

globalThis.skein = {figures: () => Object.assign({...figures}, ...more.map((tell) => tell()))};
