// The motion in its space (r, omega, h), from any side: the surface h = 0 as a
// floor with its regions, the path over it and under it, the futures, and as
// sheets all motions that leave a stick which may be left at any instant. From
// above it is the map of the surface.
import { AT } from './core.mjs';
import { Sheet, colour, dot, extent, fillShape, label, path, steady, ticks }
  from './draw.mjs';
import { short } from './decimal.mjs';
import { FLOOR, RegionMap, drawKeys, keysOf } from './regions.mjs';

const HEIGHT = 0.75; // of h over the floor; half a side of that is 1
const FROM_ABOVE = Math.PI / 2;
const CORNERS = [[-1, -1], [1, -1], [1, 1], [-1, 1]];
const AROUND = [[10, -11], [-10, -11, 'right'], [10, 11], [-10, 11, 'right']];
const NONE = { low: Infinity, high: -Infinity };
const isIn = ({ low, high }, x) => x >= low && x <= high;

// Rows of the recent past, at most `most` of them.
function trail(motion, seconds, most = 900) {
  const now = motion.now[AT.t];
  const last = motion.indexAt(now), first = motion.indexAt(now - seconds);
  const stride = Math.max(1, Math.ceil((last - first) / most));
  const rows = [];
  for (let i = first; i <= last; i += stride) rows.push(motion.row(i));
  rows.push(motion.now);
  return rows;
}

// Rows as a path, each piece in the colour of its mode, or all in that of one.
// place(row): where it is on the sheet, or null where it is not to be seen.
function drawPath(ctx, rows, place, width, one) {
  let points = [], mode;
  const end = () => points.length > 1 &&
    path(ctx, points, colour.mode[mode], width);
  for (const row of rows) {
    const next = one ?? row[AT.mode], at = place(row);
    if (!at || next !== mode) {
      end();
      points = at ? points.slice(-1) : [];
      mode = next;
    }
    if (at) points.push(at);
  }
  end();
}

export class Space {
  constructor() {
    this.sheet = new Sheet('surface');
    this.map = new RegionMap();
    this.see();
    this.begin();
  }

  begin() {
    this.ranges = { r: NONE, omega: NONE, h: NONE };
    this.sheet.isStale = true;
  }

  // round: about the axis of h.
  see(round = 0, tilt = FROM_ABOVE) {
    this.round = round;
    this.tilt = Math.max(0.12, Math.min(FROM_ABOVE, tilt));
    this.sheet.isStale = true;
  }

  draw(motion, seconds, futures, exits) {
    const ctx = this.sheet.clear();
    if (this.sheet.width < 10) return;
    const { keys, end } = keysOf(ctx, this.sheet.width);
    const past = trail(motion, seconds), { now } = motion;
    this.#fit(motion, past.concat(...[...futures, ...exits].map(({ rows }) =>
      rows)), end + 12);
    // From above nothing is seen to lie under the floor.
    const under = this.tilt === FROM_ABOVE ? -Infinity : -1e-12;
    const paths = (isUnder) => {
      this.#sheets(ctx, exits, isUnder ? 1 : 0);
      const place = (row) => (row[AT.h] < under === isUnder
        ? this.#place(row) : null);
      drawPath(ctx, past, place, 1.8);
      for (const { mode, rows } of futures)
        drawPath(ctx, rows, place, 2.2, mode);
    };
    paths(true);
    const marks = this.#floor(ctx, motion);
    paths(false);
    this.#axes(ctx);
    drawKeys(ctx, keys, this.sheet.ratio);
    for (const { head, mode } of futures) this.#point(ctx, head, mode);
    this.#point(ctx, now, now[AT.mode]);
    const { lacks } = this.map, w0 = now[AT.omega0];
    if (lacks) label(ctx, lacks, [[this.x, this.y, 'center']]);
    for (const [x, y] of marks)
      label(ctx, 'two-fold', AROUND.map(([a, b, align]) =>
        [x + a, y + b, align]), colour.ink);
    if (isIn(this.ranges.omega, w0))
      label(ctx, 'ω = ω₀', [0.7, -0.7, 0].map((part) =>
        this.#on(part, this.#part('omega', w0))).flatMap(([x, y]) =>
        [[x, y - 9, 'center'], [x, y + 9, 'center']]), colour.ink);
  }

  // Ranges, and the place on the sheet.
  #fit(motion, rows, top) {
    const { ranges, tilt } = this, { width, height } = this.sheet;
    for (const name of ['r', 'omega']) this.#reach(name, motion, rows);
    const h = extent([0, ...rows.map((row) => row[AT.h])]);
    const most = Math.max(1e-9, h.high, -h.low);
    ranges.h = steady(ranges.h, -most, most, most);
    const side = Math.abs(Math.cos(this.round)) +
      Math.abs(Math.sin(this.round));
    this.across = (width - 128) / 2 / side;
    this.up = (height - top - 48) / 2 /
      (side * Math.sin(tilt) + HEIGHT * Math.cos(tilt) / 4);
    this.x = width / 2 + 6;
    this.y = (top + height - 20) / 2;
  }

  // The range of r or omega: that of the rows, and of two-folds nearby, which
  // are worth a wider view.
  #reach(name, { core, now }, rows) {
    const least = name === 'r' ? 0.012 : 0.06;
    let { low, high } = extent([...rows.map((row) => row[AT[name]]),
      now[name === 'r' ? AT.r : AT.omega0]]);
    const size = Math.max(high - low, least);
    for (const { r, omega, [name]: x } of core.twoFolds())
      if (Math.abs(r - now[AT.r]) < 0.1 &&
        Math.abs(omega - now[AT.omega]) < 0.3 && x > low - 2 * size &&
        x < high + 2 * size) ({ low, high } = extent([low, high, x]));
    this.ranges[name] = steady(this.ranges[name], low, high, least);
  }

  // What a number is on the side of a cube, from -1 to 1.
  #part(name, value) {
    const { low, high } = this.ranges[name];
    return (2 * value - low - high) / (high - low);
  }

  // A point of the cube on the sheet.
  #on(a, b, c = 0) {
    const { round, tilt } = this;
    const cos = Math.cos(round), sin = Math.sin(round);
    return [this.x + this.across * (a * cos - b * sin), this.y - this.up *
      ((a * sin + b * cos) * Math.sin(tilt) + c * HEIGHT * Math.cos(tilt))];
  }

  #at(r, omega, h = 0) {
    return this.#on(this.#part('r', r), this.#part('omega', omega),
      this.#part('h', h));
  }

  #place = (row) => this.#at(row[AT.r], row[AT.omega], row[AT.h]);

  // The map, as it lies there. Returns: where its two-folds are.
  #floor(ctx, motion) {
    const { r, omega } = this.ranges, w0 = motion.now[AT.omega0];
    const image = this.map.of(motion, r, omega);
    const [x, y] = this.#on(-1, 1), [x1, y1] = this.#on(1, 1);
    const [x2, y2] = this.#on(-1, -1);
    ctx.save();
    ctx.globalAlpha = this.tilt === FROM_ABOVE ? 1 : 0.75;
    ctx.transform((x1 - x) / FLOOR, (y1 - y) / FLOOR, (x2 - x) / FLOOR,
      (y2 - y) / FLOOR, x, y);
    ctx.drawImage(image, 0, 0);
    ctx.restore();
    path(ctx, [...CORNERS, CORNERS[0]].map((at) => this.#on(...at)),
      colour.soft, 1);
    if (isIn(omega, w0))
      path(ctx, [this.#at(r.low, w0), this.#at(r.high, w0)], colour.soft, 1,
        [2, 4]);
    const marks = motion.core.twoFolds().filter((fold) =>
      isIn(r, fold.r) && isIn(omega, fold.omega))
      .map((fold) => this.#at(fold.r, fold.omega));
    for (const [a, b] of marks) {
      const corners = [[a - 7, b], [a, b - 7], [a + 7, b], [a, b + 7],
        [a - 7, b]];
      path(ctx, corners, colour.panel, 4);
      path(ctx, corners, colour.ink, 1.8);
    }
    return marks;
  }

  // What lies between an exit to a side and the next one.
  #sheets(ctx, exits, mode) {
    const all = exits.filter((exit) => exit.mode === mode)
      .map(({ rows }) => rows.map(this.#place));
    ctx.globalAlpha = 0.16;
    for (let i = 1; i < all.length; i++)
      fillShape(ctx, [...all[i - 1], ...all[i].toReversed()],
        colour.mode[mode]);
    ctx.globalAlpha = 0.7;
    for (const points of all) path(ctx, points, colour.mode[mode], 0.7);
    ctx.globalAlpha = 1;
  }

  // A state, and where it is over the floor.
  #point(ctx, row, mode) {
    const at = this.#place(row);
    path(ctx, [this.#at(row[AT.r], row[AT.omega]), at], colour.soft, 1, [2, 3]);
    dot(ctx, ...at, 6.5, colour.panel);
    dot(ctx, ...at, 4.5, colour.mode[mode]);
  }

  // r and omega along the sides in front, h at the corner on the left.
  #axes(ctx) {
    const places = CORNERS.map((at) => this.#on(...at));
    const corner = (i, way) => CORNERS[places.reduce((best, at, k) =>
      (way * at[i] > way * places[best][i] + 1e-6 ? k : best), 0)];
    const [a, b] = corner(1, 1), [c, d] = corner(0, -1);
    this.#axis(ctx, 'r', 'r [m]', (part) => this.#on(part, b));
    this.#axis(ctx, 'omega', 'ω [rad/s]', (part) => this.#on(a, part));
    if (Math.cos(this.tilt) < 0.2) return;
    this.#axis(ctx, 'h', 'h [m/s]', (part) => this.#on(c, d, part));
    path(ctx, [this.#on(c, d, -1), this.#on(c, d, 1)], colour.soft, 1);
  }

  // at(part): the place on the axis, from -1 to 1.
  #axis(ctx, name, words, at) {
    const { low, high } = this.ranges[name], [x0, y0] = at(0);
    const size = Math.hypot(x0 - this.x, y0 - this.y);
    const c = (x0 - this.x) / size, s = (y0 - this.y) / size;
    const align = c < -0.7 ? 'right' : c > 0.7 ? 'left' : 'center';
    const out = (part, away) => {
      const [x, y] = at(part);
      return [x + away * c, y + away * s, align];
    };
    label(ctx, words, [out(1, 12), out(0.8, 30), out(1, 30), out(0.8, 12)],
      colour.ink);
    for (const value of ticks(low, high, 4)) {
      const part = this.#part(name, value);
      path(ctx, [at(part), out(part, 4)], colour.soft, 1);
      label(ctx, short(value, 9), [out(part, 12)]);
    }
  }
}
