// Makes a run's report interactive. If this fails, the static drawings stay.
import uplotStyle from 'uplot/dist/uPlot.min.css';

import {lanesChart, scoreChart} from './charts.js';
import {element} from './page.js';
import style from './report.css';
import {followTools, offerFlight} from './report_flight.js';
import {sceneView} from './scene_view.js';

document.head.append(element('style', {}, uplotStyle + style));
const made = {};
offerFlight();
for (const [name, make] of [['score', scoreChart], ['lanes', lanesChart], ['3d', sceneView]]) {
  const figure = document.querySelector(`[data-live="${name}"]`);
  if (figure !== null) made[name] = make(figure);
}
if (made['3d'] !== undefined) followTools(made['3d']);
document.body.dataset.live = 'yes';
