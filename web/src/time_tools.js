// Slider and play button, which choose the moment that the page shows.
import {data, element, moment} from './page.js';

/**
 * Slider and play button of the moment. A run plays in half a minute, a run shorter than that in real time.
 * @param scene  undefined: there is no scene.
 */
export function timeTools(scene) {
  const slider = element(
      'input', {type: 'range', min: '0', max: String(data.end), step: 'any', 'aria-label': 'time', id: 'moment'});
  slider.value = String(data.end);
  const shown = element('output', {}, '');
  const play = element('button', {type: 'button'}, 'Play');
  let last = null;
  const stop = () => {
    last = null;
    play.textContent = 'Play';
  };
  const turn = (now) => {
    if (last === null) return;
    if (scene && !scene.isFinished()) return requestAnimationFrame(turn);
    moment.set(moment.seconds + ((now - last) / 1000) * Math.max(data.end / 30, 1));
    last = now;
    if (moment.seconds >= data.end)
      stop();
    else
      requestAnimationFrame(turn);
  };
  play.addEventListener('click', () => {
    if (last !== null) return stop();
    if (moment.seconds >= data.end) moment.set(0);
    last = performance.now();
    play.textContent = 'Pause';
    requestAnimationFrame(turn);
  });
  slider.addEventListener('input', () => moment.set(Number(slider.value)));
  const tell = (seconds) => {
    slider.max = String(data.end);
    slider.value = String(seconds);
    shown.textContent = `${seconds.toFixed(1)} s`;
  };
  moment.listen(tell);
  tell(moment.seconds);
  return element('span', {class: 'time'}, play, slider, shown);
}
