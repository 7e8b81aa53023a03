// Puts the scene on the page, with the tools that choose what it shows, and its legends.
import {makeClouds} from './clouds.js';
import {legendOf, legendOfLinks} from './legends.js';
import {data, element, replaceDrawing} from './page.js';
import {Scene} from './scene.js';
import {timeTools} from './time_tools.js';

function layer(name, objects, scene) {
  const box = element('input', {type: 'checkbox'});
  box.checked = objects.every((object) => object.visible);
  box.addEventListener('change', () => {
    for (const object of objects) object.visible = box.checked;
    scene.draw();
  });
  return element('label', {}, box, name);
}

/** Lets the user choose UAVs and points by clicks on the scene. */
function takeClicks(scene) {
  let from = null;
  const {domElement: canvas} = scene.renderer;
  canvas.addEventListener('pointerdown', (event) => (from = [event.clientX, event.clientY]));
  canvas.addEventListener('pointerup', (event) => {
    if (from === null || Math.hypot(event.clientX - from[0], event.clientY - from[1]) > 4) return;
    const body = scene.hits(event, scene.fleet.targets)[0];
    if (body) return data.onUav(scene.fleet.uavOf(body));
    const hit = scene.hits(event, [scene.structure])[0];
    if (hit) data.onPoint(hit.instanceId);
  });
}

/** @returns the scene; undefined: the browser has no WebGL 2. */
export function sceneView(figure) {
  if (document.createElement('canvas').getContext('webgl2') === null) {
    // A report keeps its static drawing. The page that follows a run has none, but needs the slider.
    if (data.follows)
      figure.append(
          element('p', {class: 'soft'},
              'This browser has no WebGL 2, which the scene needs. Everything else is shown.'),
          element('div', {class: 'scene'}, element('div', {class: 'tools'}, timeTools())));
    return;
  }
  const stage = element('div', {class: 'stage'});
  const tip = element('div', {class: 'tip'});
  tip.hidden = true;
  const live = element('div', {class: 'live'});
  figure.classList.add('scene');
  figure.parentElement.classList.add('with-scene');
  figure.querySelector('figcaption').textContent = 'In three dimensions';
  replaceDrawing(figure, live);
  live.append(stage);
  const scene = new Scene(stage, tip);
  stage.append(tip);
  const legend = element('ul', {class: 'legend'}, ...legendOf('score'));
  const choice = element('select', {id: 'colour-by', 'aria-label': 'colour of the points'});
  const colours = [
    ['score', 'score'],
    ...(data.causes_known ? [['cause', 'cause of the loss'], ['estimate', 'attainable score']] : []), ['uav', 'UAV']
  ];
  for (const [value, text] of colours) choice.append(element('option', {value}, text));
  choice.addEventListener('change', () => {
    scene.by = choice.value;
    scene.painted = null;
    legend.replaceChildren(...legendOf(scene.by));
    scene.show();
  });
  const tools = element(
      'div', {class: 'tools'}, element('label', {}, 'Points by ', choice), layer('points', [scene.structure], scene),
      layer('tracks', [scene.tracks], scene), layer('boxes', [scene.boxes], scene), layer('UAVs', [scene.fleet.object], scene),
      layer('station, collisions', [scene.marks.object], scene),
      ...(scene.links ? [layer('links', [scene.links.object], scene)] : []),
      ...(scene.goals ? [layer('goals', [scene.goals.object], scene)] : []),
      ...(scene.frusta ? [layer('cameras', [scene.frusta.object], scene)] : []), timeTools(scene));
  live.prepend(tools);
  if (data.clouds) {
    scene.clouds = makeClouds(scene);
    tools.after(scene.clouds.tools);
  }
  live.append(legend);
  if (scene.links) live.append(legendOfLinks());
  if (data.onPoint) takeClicks(scene);
  scene.fit();
  return scene;
}
