// A motion on its clock. What the page does to it is a log: inputs by hand and
// futures that were chosen, each at its tick. Set-up and log decide every bit,
// so the past is not kept but stepped again from the nearest row: a row every
// `every` steps is a snapshot. When there are MAX_ROWS, every other one goes.
import { AT, BAD_PARAMETER, COLUMNS, firstOf } from './core.mjs';
import { decimal } from './decimal.mjs';

const MAX_ROWS = 1 << 17;
const MAX_CHANGES = 1 << 16;

// CSV as the command line writes it: its columns are the first ones of a row.
const csvHeader = () => `${Object.keys(AT).slice(0, AT.set + 1)}\n`;
function csvLine(row, modes) {
  const numbers = Array.from(row.subarray(0, AT.mode), (x) => decimal(x));
  const set = modes.filter((_, mode) => row[AT.set] >> mode & 1).join('|');
  return `${[...numbers, modes[row[AT.mode]], row[AT.choices], set]}\n`;
}

export class Motion {
  // core moves; scout looks ahead: a copy of core, taken whenever it looks.
  // Both are of one module.
  constructor(core, scout) {
    this.core = core;
    this.scout = scout;
    this.every = 10;
    this.rows = new Float64Array(1024 * COLUMNS);
    this.count = 0;
    this.changes = [];
    this.log = [];
    this.stopped = null;
    this.begun = 0; // how often
  }

  // Starts the core's set-up. Returns: null or the refusal; then the motion is
  // as it was.
  begin(log = []) {
    const refusal = this.core.begin();
    if (refusal) return refusal;
    this.begun++;
    this.dt = this.core.get('dt');
    this.every = Math.max(1, Math.round(1e-3 / this.dt));
    this.count = 0;
    this.log = log.slice().sort((a, b) => a.tick - b.tick);
    this.stopped = null;
    const start = this.core.look();
    this.changes = [[0, start[AT.mode], start[AT.mode], start[AT.set],
      start[AT.choices]]];
    this.#keep();
    return null;
  }

  get now() { return this.core.row; }
  get tick() { return this.core.row[AT.tick]; }
  get last() { return (this.count - 1) * this.every; }
  // The force and the torque by hand from the present on.
  get held() { return this.#held(this.tick); }

  row(i) { return this.rows.subarray(i * COLUMNS, (i + 1) * COLUMNS); }
  value(i, column) { return this.rows[i * COLUMNS + column]; }

  // The last row that is not after a time.
  indexAt(t) {
    const i = Math.floor((t / this.dt + 1e-6) / this.every);
    return Math.max(0, Math.min(this.count - 1, i));
  }

  #keep() {
    if (this.count === MAX_ROWS) {
      this.every *= 2;
      this.count /= 2;
      for (let i = 0; i < this.count; i++)
        this.rows.copyWithin(i * COLUMNS, 2 * i * COLUMNS,
          (2 * i + 1) * COLUMNS);
      if (this.tick % this.every !== 0) return;
    }
    if ((this.count + 1) * COLUMNS > this.rows.length) {
      const more = new Float64Array(2 * this.rows.length);
      more.set(this.rows);
      this.rows = more;
    }
    this.rows.set(this.core.row, this.count++ * COLUMNS);
  }

  // How many entries of the log are at a tick or before it.
  #logged(tick) {
    return firstOf(this.log.length, (i) => this.log[i].tick > tick);
  }

  // The inputs by hand at a tick.
  #held(tick) {
    let i = this.#logged(tick) - 1;
    while (i >= 0 && this.log[i].mode !== undefined) i--;
    return i < 0 ? { force: 0, torque: 0 } : this.log[i];
  }

  // The future that was chosen for the step from a tick on.
  #taken(tick) {
    for (let i = this.#logged(tick) - 1; this.log[i]?.tick === tick; i--)
      if (this.log[i].mode !== undefined) return this.log[i];
    return null;
  }

  // One call of the core, at most up to a tick: nothing of the log, and no row
  // to keep, is in between. Returns: its status.
  #step(core, tick, target) {
    const held = this.#held(tick), taken = this.#taken(tick);
    const next = this.log[this.#logged(tick)]?.tick ?? Infinity;
    const row = (Math.floor(tick / this.every) + 1) * this.every;
    core.c.by_hand(held.force, held.torque);
    return taken ? core.c.take(taken.mode)
      : core.c.step(Math.min(target, next, row, tick + 1024) - tick);
  }

  // Moves on to a tick. Returns: whether it was reached.
  advance(target) {
    const { core } = this;
    while (this.tick < target) {
      const status = this.#step(core, this.tick, target);
      const known = this.changes[this.changes.length - 1][0];
      for (const change of core.changes())
        if (change[0] > known) this.changes.push(change);
      if (this.changes.length > MAX_CHANGES)
        this.changes.splice(1, MAX_CHANGES / 2);
      core.look();
      if (this.tick === this.count * this.every) this.#keep();
      if (status < 0) {
        const taken = this.#taken(this.tick);
        this.stopped = { tick: this.tick, text: status === BAD_PARAMETER
          ? `no step from here ends in ${core.modes[taken.mode]}`
          : core.status(status) };
        return false;
      }
    }
    return true;
  }

  // Goes to any tick, back too.
  seek(target) {
    const tick = Math.max(0, Math.round(target));
    if (tick < this.tick || tick > this.last) {
      const i = Math.min(Math.floor(tick / this.every), this.count - 1);
      if (tick < this.tick || i * this.every > this.tick)
        this.core.restore(this.row(i));
    }
    this.stopped = null;
    return this.advance(tick);
  }

  // Forgets what comes after the present.
  #cut() {
    const { tick } = this;
    this.count = Math.min(this.count, Math.floor(tick / this.every) + 1);
    this.log = this.log.filter((entry) => entry.tick < tick);
    this.changes = this.changes.filter((change) => change[0] <= tick);
    this.stopped = null;
  }

  // A force and a torque by hand from the present on.
  drive(force, torque) {
    const { held } = this;
    if (held.force === force && held.torque === torque) return;
    this.#cut();
    this.log.push({ tick: this.tick, force, torque });
  }

  // The scout at the instant before the step that ends at a tick.
  #before(tick) {
    const { scout } = this;
    scout.become(this.core);
    const i = Math.min(Math.floor((tick - 1) / this.every), this.count - 1);
    scout.restore(this.row(i));
    scout.look();
    for (let at = i * this.every; at < tick - 1; at = scout.look()[AT.tick])
      if (this.#step(scout, at, tick - 1) < 0) return false;
    scout.look();
    return true;
  }

  // The futures of the step that ends at a tick: each mode of its set and where
  // that leads in so many seconds, in `samples` rows.
  futures(tick, seconds, samples) {
    if (tick < 1 || !this.#before(tick)) return [];
    const { scout } = this;
    const before = scout.row.slice();
    const steps = Math.max(1, Math.round(seconds / this.dt / samples));
    const found = [];
    const held = this.#held(tick - 1);
    scout.c.by_hand(held.force, held.torque);
    scout.c.step(1);
    const set = scout.look()[AT.set];
    for (let mode = 0; mode < 5; mode++) {
      scout.restore(before);
      if (!(set >> mode & 1) || scout.c.take(mode) < 0) continue;
      const rows = [before, scout.look().slice()];
      for (let i = 0; i < samples && scout.c.step(steps) >= 0; i++)
        rows.push(scout.look().slice());
      found.push({ mode, rows });
    }
    return found;
  }

  // How else a stick whose rows `futures` has just found may end: by a slip at
  // some of its instants, as long as that is possible. Each is { mode, rows },
  // which ends when the stick's do.
  exits(rows, count) {
    const { scout } = this, found = [], stride = Math.ceil(rows.length / count);
    const isStick = (row) => row && row[AT.mode] === rows[1][AT.mode];
    for (let i = 1; isStick(rows[i]); i += stride) {
      for (const mode of [0, 1]) {
        scout.restore(rows[i]);
        if (!(rows[i][AT.set] >> mode & 1) || scout.c.take(mode) < 0) continue;
        const ahead = [rows[i], scout.look().slice()];
        while (ahead.length < rows.length - i &&
          scout.c.step(rows[2][AT.tick] - rows[1][AT.tick]) >= 0)
          ahead.push(scout.look().slice());
        found.push({ mode, rows: ahead });
      }
    }
    return found;
  }

  // Goes on with one of the futures of the step that ends at a tick.
  choose(tick, mode) {
    this.seek(tick - 1);
    const held = this.#held(tick - 1);
    this.#cut();
    if (held.tick === tick - 1) this.log.push(held);
    this.log.push({ tick: tick - 1, mode });
    return this.advance(tick);
  }

  // The ends of the steps from which on several futures are open: not those of
  // a slip that goes on, whose second mode is one of the finite step. A start
  // that has several is told by the first step.
  openings() {
    return this.changes.filter(([, before, mode, , choices]) =>
      choices > 1 && !(mode < 2 && before === mode))
      .map(([tick]) => Math.max(1, tick));
  }

  // What the command line prints for this set-up, part by part: a row every
  // `every` steps, the first and the last.
  *lines(every, steps) {
    const { modes } = this.core;
    this.seek(0);
    let written = 0;
    yield csvHeader() + csvLine(this.now, modes);
    for (let tick = every; tick <= steps && this.advance(tick); tick += every) {
      written = tick;
      yield csvLine(this.now, modes);
    }
    if (written < steps) {
      this.advance(steps);
      if (this.tick > written) yield csvLine(this.now, modes);
    }
  }
}
