// The opening and the tour: what is told beside the running machine, one step
// with one gesture after the other. Numbers in it are the core's, at the
// instant that is shown.
import { AT } from './core.mjs';
import { short } from './decimal.mjs';
import { $ } from './draw.mjs';
import { WORDS } from './fan.mjs';

// Steps of `chaos`: into stick+, and into one of three futures.
const ROLLS = 19230, TWO_FOLD = 20471;
const taken = ({ log }) => log.findLast((entry) => entry.mode !== undefined);
// The gesture of a choice, and what is told then.
const CHOICE = { lends: 'choices', met: (motion) => taken(motion)?.tick,
  then: (motion) => `You chose: ${WORDS[taken(motion).mode]}. Nothing in the ` +
    'laws did.' };
const slips = ({ now }) => now[AT.mode] < 2;
const turns = ({ changes }, row) => changes.filter(([tick, before, mode]) =>
  tick > TWO_FOLD && tick <= row[AT.tick] && before < 2 && mode < 2 &&
  before !== mode).length;
const instant = (row) => `t = ${short(row[AT.t], 5)} s`;

// fan: the tick whose futures are out, for `reach` seconds. asks: for the
// gesture; `lends` is what of the page it needs, which stands in the tour
// meanwhile. met(motion): the tick at which it was done; then `then` is told,
// with the row of that instant, and where `stops`, the motion stops there.
// isSpatial: it is about the space, which on a phone comes next.
const TOUR = [
  {
    title: 'One start, three futures',
    address: 'kappa=1&r=0.3&omega=-1.3&h=0',
    fan: 1, reach: 0.18, speed: -0.7, span: 0.2,
    says: () => 'Same machine, same instant: three motions, all allowed by ' +
      'the laws of friction.',
    asks: () => 'Choose one.', ...CHOICE,
  }, {
    title: 'What sticks',
    address: 'tick=2000', speed: -0.7, span: 1, plays: true,
    says: (motion) => {
      const force = short(Math.abs(motion.now[AT.F]), 2);
      return slips(motion) ? 'The wheel slips sideways. Friction acts against ' +
        `that with ${force} N.` : 'The wheel rolls and does not slip ' +
        `sideways. Friction holds it with ${force} N now; it can hold ` +
        `${short(motion.core.get('mu'))} N.`;
    },
    asks: () => 'Push it with a force, or pull it in the lens, until it slips.',
    lends: 'hand',
    met: ({ log, changes }) => log.length
      ? changes.find(([tick, , mode]) => mode < 2 && tick > log[0].tick)?.[0]
      : undefined,
    then: (motion) => (slips(motion) ? 'It slips: that was more than ' +
      'friction can hold. Let go, and it will stick again.'
      : 'It has slipped, and sticks again.'),
  }, {
    title: 'Where force and moment balance',
    address: 'r=0.19&omega=-1.03&h=0', speed: -0.7, span: 1,
    says: ({ core, now }) => {
      const brake = 1000 * core.c.delassus_at(now[AT.r], now[AT.omega]);
      return 'Friction pushes the wheel sideways, and its moment turns the ' +
        `disc against that. At r = ${short(now[AT.r])} m, 1 N of friction ` +
        `${brake < 0 ? 'speeds a slip up' : 'brakes a slip'} by ` +
        `${short(Math.abs(brake), 3)} mm/s².`;
    },
    asks: (motion, fold) => `Move the wheel past r = ${short(fold.r)} m, ` +
      'where the two balance.',
    lends: 'starts',
    met: ({ core, now }) =>
      (core.c.delassus_at(now[AT.r], now[AT.omega]) < 0 ? 0 : undefined),
    then: () => 'Here friction drives the slip that it should brake.',
  }, {
    title: 'The two-fold',
    address: `tick=${ROLLS}`, speed: -1.5, span: 0.2, stops: true,
    lends: 'play', isSpatial: true,
    says: (motion, { r, omega }) => 'Where it is blue, friction holds the ' +
      'wheel; where it is striped, it may let go to either side. Both meet ' +
      `in the two-fold: r = ${short(r)} m, ω = ${short(omega)} rad/s.`,
    asks: () => 'Play: let the wheel roll.',
    met: ({ changes }) => changes.find(([tick, , mode, , choices]) =>
      tick > ROLLS && mode === 2 && choices > 1)?.[0],
    then: (motion, row) => `It ran into the two-fold: at ${instant(row)} it ` +
      `has ${row[AT.choices]} futures.`,
  }, {
    title: 'The choice',
    address: `tick=${TWO_FOLD}`, speed: -1.5, span: 0.2, fan: TWO_FOLD,
    reach: 0.04, isSpatial: true,
    says: () => 'It may slip to either side at once, or roll on and slip ' +
      'later, at any instant. The thin lines are some of these motions.',
    asks: () => 'Turn the space, and choose.', ...CHOICE,
  }, {
    title: 'The return',
    address: `tick=${TWO_FOLD}`, speed: -1.4, span: 0.2, stops: true,
    lends: 'play', isSpatial: true,
    says: () => 'The slip winds around the two-fold, from side to side and ' +
      'wider each time.',
    asks: () => 'Play: let it wind.',
    met: ({ changes }) => changes.find(([tick, , mode]) =>
      tick > TWO_FOLD && mode === 3)?.[0],
    then: (motion, row) => `At ${instant(row)}, after ${turns(motion, row)} ` +
      `changes of side, it sticks again, at r = ${short(row[AT.r], 5)} m. ` +
      'Sooner or later it returns to the two-fold and must choose again.',
  },
];
const LENT = ['choices', 'hand', 'starts', 'play'];
const LAST = TOUR.length - 1;
export const isStep = (number) => number >= 0 && number <= LAST;

// The words of its address.
export const stepWords = (number) => ['scene=chaos', TOUR[number].address,
  `tour=${number}`];

function put(id, words) {
  const place = $(id);
  // Numbers stay beside their names and units.
  const held = words.replace(/ (?=[=N] |s\b|m\b|mm|rad)|(?<==) /g, '\u00a0');
  if (place.textContent !== held) place.textContent = held;
  place.hidden = words === '';
}

export class Tour {
  // go(number): opens a step as it begins, or leaves for null.
  constructor(motion, go) {
    Object.assign(this, { motion, number: null });
    $('tourgo').onclick = () => go(0);
    $('again').onclick = () => go(this.number);
    $('before').onclick = () => go(this.number - 1);
    $('after').onclick = () => go(this.number + 1);
    $('leave').onclick = () => go(null);
    this.homes = LENT.map((id) =>
      $(id).parentNode.insertBefore(new Comment(), $(id)));
  }

  get step() { return TOUR[this.number] ?? {}; }

  // Shows a step, or none for null.
  show(number) {
    this.number = number;
    this.isDone = false;
    this.row = null;
    const { title, lends, speed, span, isSpatial } = this.step;
    document.body.classList.toggle('touring', number !== null);
    document.body.classList.toggle('spatial', isSpatial === true);
    LENT.forEach((id, i) => (id === lends ? $('grip').append($(id))
      : this.homes[i].after($(id))));
    if (number === null) return;
    put('title', title);
    $('part').textContent = number ? `${number} of ${LAST}` : '';
    $('before').hidden = number === 0;
    $('after').hidden = number === LAST;
    $('after').textContent = number === 0
      ? 'tour in five steps' : 'next';
    $('speed').value = speed;
    $('span').value = span;
  }

  // A motion has begun. The steps are over where it has no two-fold.
  begin() {
    this.fold = this.motion.core.twoFolds().find(({ g }) => g > 0);
    if (this.number && !this.fold) this.show(null);
  }

  // Returns: the tick of a gesture that has just been done, or null.
  done() {
    const tick = this.step.met?.(this.motion);
    const isNew = tick !== undefined && !this.isDone;
    this.isDone = tick !== undefined;
    return isNew ? tick : null;
  }

  tell() {
    if (this.number === null) return;
    const { says, asks, then } = this.step;
    put('says', says(this.motion, this.fold));
    put('asks', asks(this.motion, this.fold));
    this.row = this.isDone ? this.row ?? this.motion.now.slice() : null;
    put('then', this.isDone ? then(this.motion, this.row) : '');
  }
}
