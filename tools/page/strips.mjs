// The motion over time: a ribbon of modes with the instants from which on
// several futures are open, and below it the state, the slip and the force.
import { AT, firstOf } from './core.mjs';
import { Sheet, clip, colour, dot, extent, fillShape, path, steady, text,
  ticks } from './draw.mjs';
import { short } from './decimal.mjs';

const LEFT = 134, RIGHT = 14, RIBBON = 73, MARKS = 18, AXIS = 22;
const STRIPS = [
  { names: ['r'], labels: ['r [m]'] },
  { names: ['omega'], labels: ['ω [rad/s]'] },
  { names: ['h', 'g'], labels: ['h [m/s]', 'g [m/s]'], zero: true },
  { names: ['F', 'M'], labels: ['F [N]', 'M [N m]'], zero: true },
];
const STYLE = [{ ink: 'ink', dash: [] }, { ink: 'soft', dash: [4, 3] }];

export class Strips {
  constructor() {
    this.sheet = new Sheet('strips');
    this.begin();
  }

  begin() {
    this.ranges = STRIPS.map(() => ({ low: Infinity, high: -Infinity }));
    this.sheet.isStale = true;
  }

  // The window ends at the present, or shows all that the past fills.
  #window(motion, span) {
    const now = motion.tick * motion.dt;
    const last = motion.last * motion.dt;
    if (last - now > 0.02 * span && this.to !== undefined &&
      now >= this.to - span && now <= this.to && this.span === span) return;
    this.span = span;
    this.to = Math.max(span, now + 0.15 * span);
  }

  x(t) {
    return LEFT + (t - this.to + this.span) / this.span *
      (this.sheet.width - LEFT - RIGHT);
  }

  time(x) {
    return this.to - this.span + (x - LEFT) /
      (this.sheet.width - LEFT - RIGHT) * this.span;
  }

  draw(motion, span, futures, hovered) {
    const ctx = this.sheet.clear();
    const { width, height } = this.sheet;
    if (width < 10) return;
    this.#window(motion, span);
    const from = Math.max(0, this.to - span);
    clip(ctx, LEFT - 0.5, 0, width - LEFT - RIGHT + 1, height);
    this.#grid(ctx, from, height);
    this.#ribbon(ctx, motion, from);
    ctx.restore();
    this.#openings(ctx, motion, hovered);
    this.#modes(ctx, motion);
    const room = (height - MARKS - RIBBON - AXIS - 6) / STRIPS.length;
    STRIPS.forEach((strip, i) => this.#strip(ctx, motion, strip, i,
      MARKS + RIBBON + 6 + i * room, room - 7, from, futures));
    const x = this.x(motion.tick * motion.dt);
    path(ctx, [[x, MARKS], [x, height - AXIS]], colour.ink, 1.2);
    text(ctx, 't [s]', 12, height - AXIS / 2, 'left', colour.ink);
  }

  #grid(ctx, from, height) {
    for (const t of ticks(from, this.to, this.sheet.width / 110)) {
      const x = this.x(t);
      path(ctx, [[x, MARKS], [x, height - AXIS]], colour.faint, 1);
      text(ctx, String(t), Math.max(LEFT + 4, Math.min(x, this.sheet.width -
        RIGHT - 14)), height - AXIS / 2, 'center');
    }
  }

  #modes(ctx, motion) {
    const lane = RIBBON / 5;
    motion.core.modes.forEach((name, mode) => text(ctx,
      name.replace('-', '−'), LEFT - 8, MARKS + (mode + 0.5) * lane, 'right',
      colour.mode[mode]));
  }

  // A lane for each mode, which is known by its place and not by colour alone;
  // pale lanes are the modes that are possible besides.
  #ribbon(ctx, motion, from) {
    const { changes } = motion, lane = RIBBON / 5;
    const first = Math.max(0, firstOf(changes.length, (i) =>
      changes[i][0] >= from / motion.dt) - 1);
    const end = Math.max(motion.last, motion.tick) * motion.dt;
    for (let i = first; i < changes.length; i++) {
      const [tick, , mode, set] = changes[i];
      const x0 = this.x(tick * motion.dt);
      const x1 = this.x(i + 1 < changes.length
        ? changes[i + 1][0] * motion.dt : end);
      if (x0 > this.sheet.width) break;
      const size = Math.max(x1 - x0, 1);
      for (let other = 0; other < 5; other++) {
        if (!(set >> other & 1) && other !== mode) continue;
        ctx.globalAlpha = other === mode ? 1 : 0.22;
        ctx.fillStyle = colour.mode[other];
        ctx.fillRect(x0, MARKS + other * lane + 1.5, size, lane - 3);
      }
    }
    ctx.globalAlpha = 1;
  }

  #openings(ctx, motion, hovered) {
    this.marks = [];
    let lastX = -Infinity;
    for (const tick of motion.openings()) {
      const x = this.x(tick * motion.dt);
      if (x < LEFT - 1 || x > this.sheet.width - RIGHT || x - lastX < 3)
        continue;
      lastX = x;
      this.marks.push({ tick, x });
      const y = MARKS / 2 + 1, size = tick === hovered ? 7 : 5;
      path(ctx, [[x, MARKS], [x, MARKS + RIBBON]], colour.ink,
        tick === hovered ? 1.5 : 0.5);
      fillShape(ctx, [[x - size, y - size], [x + size, y - size],
        [x, y + size]], tick === hovered ? colour.accent : colour.ink);
    }
  }

  #strip(ctx, motion, strip, index, top, size, from, futures) {
    const { width } = this.sheet;
    const lines = strip.names.map((name) => this.#line(motion, name, from));
    const ahead = futures.flatMap(({ rows }) => rows);
    const { low, high } = extent([
      lines.map((points) => points.map(([, ...ends]) => ends)),
      strip.names.map((name) => ahead.map((row) => row[AT[name]])),
      strip.zero ? 0 : []].flat(Infinity));
    const least = Math.max(1e-9, 1e-3 * Math.max(Math.abs(low),
      Math.abs(high)));
    const range = this.ranges[index] = steady(this.ranges[index], low, high,
      least);
    const y = (value) => top + size - (value - range.low) /
      (range.high - range.low) * size;
    clip(ctx, LEFT, top - 1, width - LEFT - RIGHT, size + 2);
    if (range.low < 0 && range.high > 0)
      path(ctx, [[LEFT, y(0)], [width, y(0)]], colour.line, 1);
    lines.forEach((points, i) => this.#curve(ctx, points, y, STYLE[i]));
    for (const { mode, rows, head } of futures) {
      for (const name of strip.names) {
        const at = (row) => [this.x(row[AT.t]), y(row[AT[name]])];
        path(ctx, rows.map(at), colour.mode[mode], 1.4);
        dot(ctx, ...at(head), 2.8, colour.mode[mode]);
      }
    }
    const x = this.x(motion.tick * motion.dt);
    for (const name of strip.names)
      dot(ctx, x, y(motion.now[AT[name]]), 2.8, colour.ink);
    ctx.restore();
    path(ctx, [[LEFT, top], [LEFT, top + size]], colour.soft, 1);
    text(ctx, short(range.high, 5), LEFT - 6, top + 6, 'right');
    if (size > 26)
      text(ctx, short(range.low, 5), LEFT - 6, top + size - 6, 'right');
    strip.labels.forEach((name, i) => {
      const y1 = top + size / 2 + (i - (strip.labels.length - 1) / 2) * 15;
      text(ctx, name, 12, y1, 'left', colour[STYLE[i].ink]);
    });
  }

  // [x, lowest, highest] for each column of pixels.
  #line(motion, name, from) {
    const first = Math.max(0, motion.indexAt(from) - 1);
    const last = Math.min(motion.count - 1, motion.indexAt(this.to) + 1);
    const points = [];
    for (let i = first; i <= last; i++) {
      const value = motion.value(i, AT[name]);
      const x = Math.round(2 * this.x(motion.value(i, AT.t))) / 2;
      const end = points[points.length - 1];
      if (end && end[0] === x) {
        end[1] = Math.min(end[1], value);
        end[2] = Math.max(end[2], value);
      } else points.push([x, value, value]);
    }
    return points;
  }

  #curve(ctx, points, y, { ink, dash }) {
    path(ctx, points.flatMap(([x, ...ends]) => ends.map((end) => [x, y(end)])),
      colour[ink], 1.3, dash);
  }

  // The opening that a pointer means.
  markAt({ x, y }) {
    if (y > MARKS + RIBBON) return null;
    let best = null;
    for (const mark of this.marks ?? []) {
      const away = Math.abs(mark.x - x);
      if (away < 10 && (!best || away < Math.abs(best.x - x))) best = mark;
    }
    return best;
  }
}
