// Flies one UAV by hand, with the keyboard or a gamepad. The page sends a command to the server whenever it changes,
// and repeats it while the UAV is to move, because a command lapses on the server (sim_server/hand_desk.hpp).
import style from './hand_flight.css';
import {data, element} from './page.js';

const kPeriod = 50;   // ms; shortest time between two orders
const kRenew = 250;   // ms; a command lapses after 1 s
const kDeadZone = 0.12;
const kYawRate = 0.8, kGimbalRate = 0.5;  // rad/s
const kMostUp = 3;    // m/s; greatest vertical speed
const kSpeeds = {min: 0.5, max: 6, step: 0.5, value: 2};  // m/s

/**
 * The axis and the sign of each key: ahead, left, up, yaw (left), pitch of the camera (down), yaw of the camera (left).
 */
const kKeys = {
  KeyW: ['ahead', 1], ArrowUp: ['ahead', 1], KeyS: ['ahead', -1], ArrowDown: ['ahead', -1],
  KeyA: ['left', 1], ArrowLeft: ['left', 1], KeyD: ['left', -1], ArrowRight: ['left', -1],
  KeyR: ['up', 1], Space: ['up', 1], KeyF: ['up', -1], ShiftLeft: ['up', -1], ShiftRight: ['up', -1],
  KeyQ: ['yaw', 1], KeyE: ['yaw', -1],
  KeyI: ['pitch', -1], KeyK: ['pitch', 1], KeyJ: ['turn', 1], KeyL: ['turn', -1],
};
const kLegend = [
  ['W A S D, arrows', 'ahead, left, back, right'], ['R or Space, F or Shift', 'up, down'], ['Q, E', 'turn left, right'],
  ['I, K, J, L', 'camera up, down, left, right'], ['gamepad', 'left stick up and turn, right stick ahead and left, d-pad camera'],
];
const kHeld = [
  '', 'held back: what lies ahead is not proved to be free yet', 'held back: it would come too near to something',
  'held back: another UAV is in the way', 'held back: it is too low; take it up first',
];

const nothing = () => ({ahead: 0, left: 0, up: 0, yaw: 0, pitch: 0, turn: 0});
const bounded = (value) => Math.max(-1, Math.min(1, value));

/** @returns a stick's value without the dead zone: a stick is never exactly at its centre. */
function stick(value) {
  const beyond = Math.max(0, Math.abs(value ?? 0) - kDeadZone) / (1 - kDeadZone);
  return Math.sign(value ?? 0) * beyond;
}

/** Adds the values of all gamepads with the standard mapping. */
function fromGamepads(axes) {
  for (const pad of navigator.getGamepads?.() ?? []) {
    if (!pad?.connected || pad.mapping !== 'standard') continue;
    const down = (button) => (pad.buttons[button]?.pressed ? 1 : 0);
    axes.yaw -= stick(pad.axes[0]);
    axes.up -= stick(pad.axes[1]);
    axes.left -= stick(pad.axes[2]);
    axes.ahead -= stick(pad.axes[3]);
    axes.pitch += down(13) - down(12);
    axes.turn += down(14) + down(4) - down(15) - down(5);
  }
}

/** @returns the command of the pressed keys and of the gamepads. @param speed  of a full deflection [m/s]. */
function commandOf(keys, speed) {
  const axes = nothing();
  for (const key of keys) axes[kKeys[key][0]] += kKeys[key][1];
  fromGamepads(axes);
  for (const name of Object.keys(axes)) axes[name] = bounded(axes[name]);
  const level = Math.max(1, Math.hypot(axes.ahead, axes.left));
  const exact = (value) => Math.round(value * 1000) / 1000 + 0;  // no -0
  return {
    velocity: [exact(axes.ahead * speed / level), exact(axes.left * speed / level), exact(axes.up * Math.min(speed, kMostUp))],
    yaw_rate: exact(axes.yaw * kYawRate),
    gimbal: [exact(axes.pitch * kGimbalRate), exact(axes.turn * kGimbalRate)],
  };
}

const rests = ({velocity, yaw_rate: yaw, gimbal}) => [...velocity, yaw, ...gimbal].every((value) => value === 0);

function inWords(command) {
  if (rests(command)) return 'rest';
  const [ahead, left, up] = command.velocity;
  const [pitch, turn] = command.gimbal;
  const part = (value, more, less, unit) => value === 0 ? [] : [`${value > 0 ? more : less} ${Math.abs(value).toFixed(1)} ${unit}`];
  return [
    ...part(ahead, 'ahead', 'back', 'm/s'), ...part(left, 'left', 'right', 'm/s'), ...part(up, 'up', 'down', 'm/s'),
    ...part(command.yaw_rate, 'turn left', 'turn right', 'rad/s'), ...part(pitch, 'camera down', 'camera up', 'rad/s'),
    ...part(turn, 'camera left', 'camera right', 'rad/s'),
  ].join(', ');
}

/** The user's control of one UAV at a time. @param order  function that sends an order. */
class Hands {
  constructor(order) {
    this.order = order;
    this.uav = null;
    this.keys = new Set();
    this.speed = kSpeeds.value;
    this.command = commandOf(this.keys, this.speed);
    this.said = null;
    this.saidAt = 0;
    // Called before any other listener of the page: during a flight by hand, these keys have no other effect.
    addEventListener('keydown', (event) => this.press(event), {capture: true});
    addEventListener('keyup', (event) => this.keys.delete(event.code) && this.say(), {capture: true});
    for (const name of ['blur', 'pagehide']) addEventListener(name, () => this.drop());
    document.addEventListener('visibilitychange', () => document.hidden && this.drop());
  }

  /** Takes control of a UAV. @param onLeave  called when the user gives up control. */
  take(uav, onLeave) {
    this.leave();
    this.uav = uav;
    this.onLeave = onLeave;
    this.said = null;
    this.timer = setInterval(() => this.say(), kPeriod);
  }

  leave() {
    if (this.uav === null) return;
    this.drop();
    clearInterval(this.timer);
    this.uav = null;
    this.onLeave();
  }

  press(event) {
    const busy = event.ctrlKey || event.altKey || event.metaKey || ['INPUT', 'SELECT', 'TEXTAREA'].includes(event.target.tagName);
    if (this.uav === null || busy) return;
    if (event.code !== 'Escape' && !(event.code in kKeys)) return;
    event.preventDefault();
    event.stopPropagation();
    if (event.code === 'Escape') return this.leave();
    this.keys.add(event.code);
  }

  /** Treats all keys as released. */
  drop() {
    this.keys.clear();
    if (this.uav !== null) this.say(true);
  }

  /** Sends the command if it is due. @param rest  commands the UAV to rest, even if a gamepad says otherwise. */
  say(rest = false) {
    if (this.uav === null) return;
    const away = rest || document.hidden || !document.hasFocus();
    this.command = away ? {velocity: [0, 0, 0], yaw_rate: 0, gimbal: [0, 0]} : commandOf(this.keys, this.speed);
    const text = JSON.stringify(this.command);
    const now = performance.now();
    const due = now - this.saidAt >= kPeriod * 0.9 || rest;
    const old = text === this.said && (rests(this.command) || now - this.saidAt < kRenew);
    if (!due || old) return;
    this.order({do: 'fly', uav: this.uav, ...this.command});
    this.said = text;
    this.saidAt = now;
  }
}

function legend() {
  return element('dl', {class: 'keys'}, ...kLegend.flatMap(([keys, what]) => [element('dt', {}, keys), element('dd', {}, what)]));
}

/**
 * @param order  function that sends an order. @param follow  makes the view follow a UAV, through its camera or not.
 * @returns the panel; null: no UAV is flown by hand.
 */
export function handPanel(order, follow) {
  const names = data.by_hand ?? [];
  if (data.mode !== 'live' || names.length === 0) return null;
  document.head.append(element('style', {}, style));
  const hands = new Hands(order);
  const which = element('select', {id: 'hand-uav', 'aria-label': 'UAV to fly'}, ...names.map((value) => element('option', {value}, value)));
  which.hidden = names.length === 1;
  const take = element('button', {type: 'button', id: 'take', class: 'main', 'aria-pressed': 'false'}, '');
  const through = element('input', {type: 'checkbox', id: 'hand-camera'});
  const speed = element('input', {type: 'range', id: 'hand-speed', ...kSpeeds});
  const speedText = element('output', {for: 'hand-speed'}, '');
  const wanted = element('strong', {id: 'wanted'}, '');
  const held = element('p', {id: 'held', class: 'held', role: 'status'}, '');
  const made = element(
      'section', {class: 'panel hand', id: 'hand', tabindex: '-1', 'aria-label': 'Fly by hand'}, element('h2', {}, ''),
      element('div', {class: 'tools-row'}, which, take, element('label', {}, through, ' through its camera')),
      element('label', {class: 'speed'}, 'speed ', speed, speedText), element('p', {class: 'wanted'}, 'wanted: ', wanted), held,
      legend());
  const index = () => data.uavs.findIndex(({name}) => name === which.value);
  const show = () => {
    const flies = hands.uav !== null;
    made.classList.toggle('taken', flies);
    made.querySelector('h2').textContent = flies ? `You fly ${hands.uav}` : `Fly ${which.value} by hand`;
    take.textContent = flies ? 'Let go (Escape)' : 'Take the controls';
    take.setAttribute('aria-pressed', String(flies));
    speedText.textContent = `${hands.speed.toFixed(1)} m/s`;
    const now = data.now?.hand?.[which.value];
    wanted.textContent = now ? inWords({gimbal: flies ? hands.command.gimbal : [0, 0], ...now}) : '–';
    const dead = data.uavs[index()]?.collided !== null;
    held.textContent = dead ? 'It collided, and cannot be flown any more.' : now ? kHeld[now.held] ?? '' : '';
  };
  const letGo = () => {
    take.focus();
    show();
  };
  take.addEventListener('click', () => {
    if (hands.uav !== null) return hands.leave();
    hands.take(which.value, letGo);
    made.focus({preventScroll: true});  // else Space would press the button
    follow(index(), through.checked);
    show();
  });
  which.addEventListener('change', () => {
    hands.leave();
    show();
  });
  through.addEventListener('change', () => {
    if (hands.uav !== null) follow(index(), through.checked);
    made.focus({preventScroll: true});
  });
  speed.addEventListener('input', () => {
    hands.speed = Number(speed.value);
    show();
  });
  speed.addEventListener('change', () => made.focus({preventScroll: true}));  // else arrow keys would move it
  show();
  return {element: made, show};
}
