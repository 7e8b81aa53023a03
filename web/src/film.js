// The page as a film sees it: one moment after another, set from outside (cli/film/). Only a page that holds its flight
// is filmed: there nothing comes in between.
import {data, element, moment} from './page.js';

const drawnPicture = () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));

/**
 * @param open    shows what an address says
 * @param panels  shows what all panels say of the moment; a reader's are drawn less often than the scene, by the clock
 */
export function offerFilm(open, panels) {
  window.film = {
    /** Leaves out what only a reader needs. @returns when the flight ends, and where the address begins [s]. */
    async begin(address) {
      document.body.classList.add('film');
      if (address) history.replaceState(null, '', address.startsWith('#') ? address : `#${address}`);
      const {time} = open();
      panels();
      await drawnPicture();
      return {end: data.end, from: Number.isFinite(time) ? time : 0};
    },
    async show(seconds) {
      moment.set(seconds);
      panels();
      await drawnPicture();
    },
  };
  document.body.append(element('span', {id: 'filmable', hidden: ''}));
}
