// The page: one motion, one clock, and what looks at them or acts on them.
import { AT, Core } from './core.mjs';
import { read, sceneWord, whole, write } from './address.mjs';
import { Line, Record, openSerial } from './board.mjs';
import { short } from './decimal.mjs';
import { $, readColours } from './draw.mjs';
import { Fan } from './fan.mjs';
import { Far } from './far.mjs';
import { download, takeFiles } from './files.mjs';
import { Mechanism } from './mechanism.mjs';
import { Motion } from './motion.mjs';
import { Hand, Panel } from './panel.mjs';
import { dragTime, holdMachine, turnSpace } from './pointers.mjs';
import { Space } from './space.mjs';
import { commandLine, showState, tellTime } from './status.mjs';
import { Strips } from './strips.mjs';
import { Tour, stepWords } from './tour.mjs';

const BUDGET = 9;   // of a frame, for steps [ms]
const PATIENT = 40; // of one that is on its way to a far goal

const bytes = Uint8Array.from('@CORE@'.match(/../g), (x) => parseInt(x, 16));
const compiled = new WebAssembly.Module(bytes);
const core = new Core(compiled), scout = new Core(compiled);
const motion = new Motion(core, scout);
const calm = matchMedia('(prefers-reduced-motion: reduce)');

readColours();
const mechanism = new Mechanism(), space = new Space(), strips = new Strips();
const views = [mechanism, space, strips];
const hand = new Hand(motion, push);
const panel = new Panel(core, change, refuse);
const far = new Far(stop);
const fan = new Fan(motion, choose);
const page = { motion, play, seek, showFan, openAt, push,
  isLive: () => live !== null };
const pull = holdMachine(mechanism, page);
const tour = new Tour(motion, goTo);

let scene = 0;
let isPlaying = false;
let goal = 0;            // the tick that the motion is to reach
let part = 0;            // of a step, left over from the last frame
let isFanDue = false;    // at the goal, for the tour
let live = null;         // a board's line in place of the motion
let isStale = true;
let writing = null;      // the rows that are written to a file
let draws = 0;

const speed = () => 10 ** Number($('speed').value);
const span = () => Number($('span').value);

function say(words) {
  $('said').textContent = words;
  clearTimeout(say.timer);
  say.timer = setTimeout(() => { $('said').textContent = ''; },
    4000 + 60 * words.length);
}

const address = (tick = motion.tick) =>
  write(core, scene, motion.log, tick, tour.number);

function remember() {
  isStale = true;
  clearTimeout(remember.timer);
  remember.timer = setTimeout(() => history.replaceState(null, '',
    `#${address(Math.max(motion.tick, goal))}`), 250);
}

// Ends what takes long: what is reached is where the motion stays.
function stop() {
  writing = null;
  goal = motion.tick;
  far.end();
  remember();
}

// What is refused is said twice: where it was entered, and in sight, because on
// a phone the panel is far below.
function refuse(words) {
  panel.say(words);
  if (words) say(words);
}

// Opens a file with a scene, or says what is wrong in it.
async function openFile(file) {
  const refusal = core.takeFile(file.name, await file.text());
  refuse(refusal);
  if (!refusal) openScene(core.ownScene);
}

// Another scene runs where this one did, or where the tour has shown one.
function openScene(number) {
  const runs = isPlaying || tour.number !== null && !calm.matches;
  open(whole([sceneWord(core, number)]));
  play(runs);
  remember();
}

// Opens a step of the tour as it begins, or leaves the tour for null.
function goTo(number) {
  play(false);
  if (number === null) tour.show(null);
  else open(whole(stepWords(number)));
  play(Boolean(tour.step.plays) && !calm.matches);
  remember();
}

// Begins what an address says; where the core refuses that, the scene as it
// comes, or the first one: a file may have a start that no motion has.
function begin(text) {
  const first = read(core, text);
  const refusal = motion.begin(first.log);
  if (!refusal) {
    for (const name of first.names) {
      const why = core.unused(name);
      if (why) first.told.push(`${name} has no effect: ${why}`);
    }
    return first;
  }
  for (const number of [first.scene, 0]) {
    const next = read(core, whole([sceneWord(core, number)]));
    if (motion.begin()) continue;
    next.told = [...first.told, `${refusal}; scene ${core.scenes[number]} is ` +
      'shown unchanged'];
    return next;
  }
  throw new Error(refusal);
}

// Opens what an address says; nothing, and the page begins with its story.
function open(text) {
  const got = begin(text === '' ? whole(stepWords(0)) : text);
  say('');
  scene = got.scene;
  if (core.file) $('scene').options[core.ownScene] =
    new Option(core.scenes[core.ownScene]);
  $('scene').selectedIndex = scene;
  $('shows').textContent = core.text(core.c.scene_shows(scene));
  panel.show(got.own);
  refuse(got.told.length ? `address: ${got.told.join('; ')}` : null);
  views.forEach((view) => view.begin(core));
  goal = got.tick;
  part = 0;
  showFan(null);
  tour.show(got.tour);
  tour.begin();
  isFanDue = tour.step.fan !== undefined && got.log.length === 0;
  if (isFanDue) goal = tour.step.fan;
  if (got.tour !== null) space.see(-0.5, 0.6);
}

// A number of the set-up has a new value: the same motion, from its start.
// Returns: null or why not; then the set-up is as it was.
function change(name, value) {
  const before = core.setup.slice();
  const time = Math.max(motion.tick, goal) * motion.dt;
  let refusal = core.refusal(name, value), given = '';
  if (!refusal) {
    core.set(name, value);
    if (name === 'law') given = core.fill(panel.own);
    refusal = motion.begin(motion.log);
  }
  isStale = true;
  if (refusal) {
    core.setup.set(before);
    return refusal;
  }
  if (given) say(`law ${core.lists.law[value]}: ${given}`);
  goal = Math.round(time / motion.dt);
  mechanism.begin(core);
  tour.begin();
  showFan(null);
  remember();
  return null;
}

// The futures of the step that ends at a tick, or none.
function showFan(tick) {
  if (tick === fan.tick) return;
  fan.show(tick, tour.step.fan === tick ? tour.step.reach
    : Math.min(0.15, 0.06 * span()));
  isStale = true;
}

function choose(mode) {
  const { tick } = fan;
  const isTaken = motion.choose(tick, mode);
  if (!isTaken)
    say(`not taken: ${motion.stopped?.text ?? core.modes[mode]}`);
  goal = motion.tick;
  showFan(null);
  if (tour.number !== null) play(isTaken);
  remember();
}

function play(on) {
  if (isPlaying && !on) goal = motion.tick;
  isPlaying = on;
  $('play').classList.toggle('on', on);
  $('play').setAttribute('aria-label', on ? 'Pause' : 'Play');
  if (!on) remember();
}

// What lies behind the last row is stepped frame by frame, within the budget.
function seek(tick) {
  goal = Math.max(0, Math.round(tick));
  motion.seek(Math.min(goal, Math.max(motion.last, motion.tick)));
  remember();
}

// The nearest opening at or before the present, else the next one.
function nearest() {
  const all = motion.openings();
  const past = all.filter((tick) => tick <= motion.tick);
  const tick = past.length ? past[past.length - 1] : all[0];
  if (tick === undefined) return say('so far every instant has one future');
  play(false);
  return openAt(tick);
}

// Goes to an instant at which several futures are open, and shows them.
function openAt(tick) {
  seek(tick);
  motion.seek(tick);
  showFan(tick);
}

// By hand, from the present on: what lay ahead is another motion now.
function push(force, torque) {
  motion.drive(force, torque);
  goal = motion.tick;
  showFan(null);
  remember();
  if (tour.number !== null) play(true);
}

// Steps of a frame: towards the goal, for as long as the budget lasts.
function move(seconds) {
  const started = performance.now();
  if (isPlaying && motion.tick >= goal) {
    part += seconds * speed() / motion.dt;
    const steps = Math.floor(part);
    part -= steps;
    goal = motion.tick + steps;
    pull();
  }
  const budget = isPlaying ? BUDGET : PATIENT;
  while (motion.tick < goal && performance.now() - started < budget) {
    isStale = true;
    if (!motion.advance(Math.min(goal, motion.tick + 500))) {
      say(`stopped at t = ${short(motion.tick * motion.dt, 6)} s: ` +
        motion.stopped.text);
      goal = motion.tick;
      play(false);
      break;
    }
  }
  // What could not be done in time is not owed.
  if (isPlaying && goal - motion.tick > 1e5) goal = motion.tick;
  follow();
  if (writing) return;
  if (isPlaying || motion.tick >= goal) far.end();
  else far.tell(`to t = ${short(goal * motion.dt, 6)} s`, motion.tick, goal);
}

// What the tour waits for: an instant to show futures of, or a gesture.
function follow() {
  if (isFanDue && motion.tick >= goal) {
    isFanDue = false;
    showFan(goal);
  }
  const tick = tour.done();
  if (tick === null) return;
  isStale = true;
  if (!tour.step.stops) return;
  play(false);
  seek(tick);
}

const csvSteps = () => Math.max(motion.tick, 1);

// Writes the rows from a motion of its own, so that this one is free.
async function writeRows() {
  const other = new Core(compiled), steps = csvSteps(), parts = [];
  other.become(core);
  const copy = new Motion(other, scout), name = `${core.scenes[scene]}.csv`;
  copy.begin(motion.log);
  const rows = writing = copy.lines(motion.every, steps);
  let until = 0;
  for (const row of rows) {
    parts.push(row);
    if (performance.now() < until) continue;
    far.tell(name, copy.tick, steps);
    await new Promise(requestAnimationFrame);
    if (writing !== rows) return;
    until = performance.now() + BUDGET;
  }
  writing = null;
  far.end();
  download(name, parts.join(''));
}

async function share() {
  history.replaceState(null, '', `#${address()}`);
  try {
    await navigator.clipboard.writeText(location.href);
    say('The link is copied: it holds this motion to the bit.');
  } catch {
    say('The address of this page holds this motion to the bit.');
  }
}

function offerBoard() {
  $('board').textContent = 'board';
  $('board').onclick = () => openSerial(connect).catch((error) =>
    say(error.message));
}

// What acts on the motion does so only where the motion is shown.
function watch(record) {
  live = record;
  isStale = true;
  for (const id of ['scene', 'open', 'tourgo', 'save', 'share', 'csv',
    'transport', 'row', 'side']) $(id).inert = live !== null;
}

// Shows what a board sends in place of the motion, until its line ends.
// line: { readable, writable }, as WebSerial opens a port. tell: may be absent;
// gets each row. Returns: the counters of the decoder.
async function connect(line, tell) {
  watch(new Record(core));
  const reader = new Line(compiled, (row) => {
    live.take(row);
    tell?.(row);
    isStale = true;
  });
  play(false);
  showFan(null);
  $('board').textContent = 'disconnect';
  $('board').onclick = () => reader.close();
  try {
    await reader.read(line);
    say(`the board's line ended after ${reader.counters[3]} rows` +
      (reader.counters[8] > 0 ? ' of more than one run' : ''));
  } catch (error) {
    say(`the board's line failed: ${error.message}`);
  }
  offerBoard();
  watch(null);
  return reader.counters;
}

function frame(now) {
  const seconds = Math.min(0.05, (now - (frame.before ?? now)) / 1000);
  frame.before = now;
  if (!live) move(seconds);
  if (fan.run(now, calm.matches)) isStale = true;
  if (isStale || views.some((view) => view.sheet.isStale)) draw();
  requestAnimationFrame(frame);
}

function draw() {
  isStale = false;
  views.forEach((view) => { view.sheet.isStale = false; });
  fan.run(performance.now(), calm.matches);
  const { futures } = fan, shown = live ?? motion;
  mechanism.draw(shown.now, futures);
  space.draw(shown, span() / 2, futures, fan.exits);
  strips.draw(shown, span(), futures, fan.tick);
  tour.tell();
  hand.show();
  showState(shown.now, core.modes);
  tellTime(strips.sheet.canvas, shown.now, shown.last * shown.dt, core.modes);
  $('pace').textContent = `× ${short(speed(), 2)}`;
  if (!isPlaying || draws++ % 30 === 0)
    $('command').textContent = commandLine(core, scene, motion, csvSteps());
}

// A slider keeps the keys that move it, another field all keys but Escape, by
// which one leaves it.
function keys(event) {
  const { target } = event, key = event.key.length > 1 ? event.key
    : event.key.toLowerCase();
  const isField = /^(INPUT|SELECT)$/.test(target.tagName);
  if (event.ctrlKey || event.metaKey || event.altKey || live) return;
  if (isField && key === 'Escape') target.blur();
  else if (isField && (target.type !== 'range' ||
    /^(Arrow|Home|End)/.test(key))) return;
  const steps = event.shiftKey ? 100 : 1;
  const actions = {
    ' ': () => play(!isPlaying),
    ArrowLeft: () => (play(false), seek(motion.tick - steps)),
    ArrowRight: () => (play(false), seek(motion.tick + steps)),
    Home: () => seek(0),
    End: () => seek(motion.last),
    f: nearest,
    n: () => $('after').checkVisibility() && $('after').click(),
    p: () => $('before').checkVisibility() && $('before').click(),
    '?': () => say($('askkeys').title),
    Escape: () => (showFan(null), stop()),
  };
  const future = fan.futures[Number(key) - 1];
  const action = future ? () => choose(future.mode) : actions[key];
  if (!action || (key === ' ' && target.tagName === 'BUTTON')) return;
  event.preventDefault();
  action();
}

function wire() {
  core.scenes.forEach((name) => $('scene').append(new Option(name)));
  $('scene').onchange = () => openScene($('scene').selectedIndex);
  $('askkeys').onclick = () => say($('askkeys').title);
  takeFiles($('open'), $('file'), openFile);
  $('save').onclick = () => download(`${core.scenes[scene]}.scene`,
    core.text(core.c.scene_print()));
  $('play').onclick = () => play(!isPlaying);
  $('home').onclick = () => seek(0);
  $('back').onclick = () => (play(false), seek(motion.tick - 1));
  $('next').onclick = () => (play(false), seek(motion.tick + 1));
  $('fan').onclick = nearest;
  $('csv').onclick = writeRows;
  $('share').onclick = share;
  offerBoard();
  $('speed').oninput = $('span').onchange = () => { isStale = true; };
  addEventListener('keydown', keys);
  // The address that was entered: by now it may be one that was remembered.
  addEventListener('hashchange', ({ newURL = location.href }) => {
    play(false);
    open(new URL(newURL).hash.slice(1));
  });
  matchMedia('(prefers-color-scheme: dark)').onchange = () => {
    readColours();
    isStale = true;
  };
  dragTime(strips, page);
  turnSpace(space);
}

wire();
open(location.hash.slice(1));
remember();
requestAnimationFrame(frame);
// For the tests, and for whoever has a line of their own.
window.twofold = { core, motion, views, connect, play, seek, showFan, draw, fan,
  tour, goTo, AT, arrived: () => motion.tick >= goal && !isFanDue,
  read: (text) => read(core, text),
  writeOf: (...what) => write(core, ...what),
  write: () => address() };
