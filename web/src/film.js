// The page's interface for films: `skein replay` (cli/film/) sets one moment after another. Only a self-contained page
// is filmed, because no data arrive there between two pictures.
import {data, element, moment} from './page.js';

const drawnPicture = () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));

/**
 * @param open    shows what the page's address specifies; returns its time [s]
 * @param panels  draws all panels; for a reader, they are drawn less often than the scene
 */
export function offerFilm(open, panels) {
  window.film = {
    /** Hides the controls. @returns the end of the flight, and the time in the address [s]. */
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
