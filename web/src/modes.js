// Kinds of the activities that UAVs report, each with a colour for the lanes. The words are those of Skein's on-board
// software (docs/view.md); a user's program may report others.
import {element, swatch} from './page.js';

const kOther = {colour: 'q2', text: 'other', begins: ['']};
const kKinds = [
  {colour: 'q0', text: 'on the ground, takes off, lands', begins: ['on the ground', 'takes off', 'waits to be shown its way up', 'flies to its landing place']},
  {colour: 'c0', text: 'flies to goals, rests there', begins: ['flies to a goal', 'flies along', 'flies to a set-point', 'rests at its goal', 'holds its place', 'sends commands']},
  {colour: 'c3', text: 'shows another UAV its way up', begins: ['shows ']},
  {colour: 'c4', text: 'has no goal or way, recovers', begins: ['has no goal', 'looks for a way', 'looks around', 'flies nearer', 'tries ', 'climbs to see more', 'flies back', 'makes room']},
  {colour: 'c1', text: 'stands', begins: ['stands: ']},
  {colour: 'c2', text: 'brings captures home', begins: ['returns', 'delivers', 'waits for a link', 'stays ']},
  kOther,
];

const kindOf = (mode) => kKinds.find(({begins}) => begins.some((begin) => mode.startsWith(begin)));

/**
 * Computes the times of each kind of activity of a UAV.
 * @param said  times [s], ascending, and activity reports. @param end  end of the last span [s].
 * @returns by kind: its colour, and begin and end of each of its spans, one after the other [s].
 */
export function spansOf({t, what}, end) {
  const spans = new Map();
  let last = null;
  for (let i = 0; i < t.length; ++i) {
    const kind = kindOf(what[i].mode);
    const until = i + 1 < t.length ? t[i + 1] : end;
    if (!spans.has(kind)) spans.set(kind, []);
    const those = spans.get(kind);
    if (kind === last) those[those.length - 1] = until;
    else those.push(t[i], until);
    last = kind;
  }
  return [...spans].map(([{colour}, flat]) => ({colour, flat}));
}

/** @returns the activities that a UAV reported and that belong to no kind. */
export const otherModes = (said) => [...new Set((said?.what ?? []).map(({mode}) => mode))].filter((mode) => kindOf(mode) === kOther);

/** @returns the legend of the colours. */
export function legendOfModes() {
  return element('ul', {class: 'legend', id: 'modes'}, ...kKinds.map(({colour, text}) => element('li', {}, swatch(colour), text)));
}
