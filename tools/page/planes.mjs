// Two planes on the clock of the motion: the slip (g, h), and the surface h = 0
// over (r, omega) with the regions of its points.
import { AT, REGIONS } from './core.mjs';
import { Frame, Sheet, colour, dot, label, path, roundUp, steady, text }
  from './draw.mjs';

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

// The path of rows, each piece in the colour of its mode.
function drawTrail(ctx, rows, place, width = 1.8) {
  for (let i = 1; i < rows.length;) {
    const mode = rows[i][AT.mode], points = [place(rows[i - 1])];
    while (i < rows.length && rows[i][AT.mode] === mode)
      points.push(place(rows[i++]));
    path(ctx, points, colour.mode[mode], width);
  }
}

function drawFutures(ctx, futures, place) {
  for (const { mode, rows } of futures) {
    const points = rows.map(place);
    path(ctx, points, colour.mode[mode], 1.8);
    const [x, y] = points[points.length - 1];
    dot(ctx, x, y, 4, colour.mode[mode]);
  }
}

function drawNow(ctx, x, y, mode) {
  dot(ctx, x, y, 6.5, colour.panel);
  dot(ctx, x, y, 4.5, colour.mode[mode]);
}

const REGION_COLOUR = ['sliding', 'escaping', 'up', 'down', 'line', 'panel'];

// Pale lines, so that regions differ without their colours: escaping ones.
let tile = null;
function hatch(ctx) {
  if (tile?.title !== colour.escaping) {
    tile = document.createElement('canvas');
    tile.title = colour.escaping; // of which colours it is
    tile.width = tile.height = 8;
    const c = tile.getContext('2d');
    c.strokeStyle = colour.mode[0];
    c.globalAlpha = 0.5;
    c.lineWidth = 1.2;
    c.beginPath();
    for (const shift of [-8, 0, 8]) {
      c.moveTo(shift - 1, 9);
      c.lineTo(shift + 9, -1);
    }
    c.stroke();
  }
  return ctx.createPattern(tile, 'repeat');
}

const NONE = { low: Infinity, high: -Infinity };

export class SlipPlane {
  constructor() {
    this.sheet = new Sheet('plane');
    this.begin();
  }

  begin() {
    this.ranges = { g: NONE, h: NONE };
    this.sheet.isStale = true;
  }

  // A range with 0 in it; the least shows rounding as a line.
  #range(name, rows, least) {
    let low = 0, high = 0;
    for (const row of rows) {
      low = Math.min(low, row[AT[name]]);
      high = Math.max(high, row[AT[name]]);
    }
    const more = Math.max(0, least - (high - low)) / 2;
    this.ranges[name] = steady(this.ranges[name], low - more, high + more,
      least);
    return this.ranges[name];
  }

  draw(motion, seconds, futures) {
    const ctx = this.sheet.clear();
    if (this.sheet.width < 10) return;
    const past = trail(motion, seconds);
    const seen = past.concat(...futures.map((future) => future.rows));
    const g = this.#range('g', seen, 1e-3);
    const frame = new Frame(this.sheet, g,
      this.#range('h', seen, (g.high - g.low) / 1000));
    this.frame = frame;
    frame.clip(ctx);
    this.#halves(ctx, frame);
    this.#line(ctx, frame, motion);
    path(ctx, [[frame.x(0), frame.top], [frame.x(0), frame.bottom]],
      colour.line, 1);
    const place = (row) => [frame.x(row[AT.g]), frame.y(row[AT.h])];
    drawTrail(ctx, past, place);
    drawFutures(ctx, futures, place);
    const [x, y] = place(motion.now);
    drawNow(ctx, x, y, motion.now[AT.mode]);
    ctx.restore();
    this.#names(ctx, frame);
    frame.axes(ctx, 'g', 'h');
  }

  #halves(ctx, frame) {
    ctx.globalAlpha = 0.07;
    ctx.fillStyle = colour.mode[0];
    ctx.fillRect(frame.left, frame.top, frame.right - frame.left,
      frame.y(0) - frame.top);
    ctx.fillStyle = colour.mode[1];
    ctx.fillRect(frame.left, frame.y(0), frame.right - frame.left,
      frame.bottom - frame.y(0));
    ctx.globalAlpha = 1;
  }

  // h = 0, by the regions that it has at the present r.
  #line(ctx, frame, motion) {
    const count = Math.max(2, Math.round((frame.right - frame.left) / 3));
    const { low, high } = frame.rangeX;
    const regions = motion.core.regionsAt(motion.now[AT.r], low, high, count);
    if (!regions) return;
    const width = (frame.right - frame.left) / count, y = frame.y(0);
    const lines = hatch(ctx);
    for (let i = 0; i < count; i++) {
      const region = regions[i];
      if (region > 1) continue;
      ctx.fillStyle = colour[REGION_COLOUR[region]];
      ctx.fillRect(frame.left + i * width, y - 5, width + 0.6, 10);
      if (region !== 1) continue;
      ctx.fillStyle = lines;
      ctx.fillRect(frame.left + i * width, y - 5, width + 0.6, 10);
    }
    path(ctx, [[frame.left, y], [frame.right, y]], colour.soft, 1);
  }

  #names(ctx, frame) {
    const { left, right, top, bottom } = frame, y = frame.y(0);
    const isWide = frame.x(0) - left > 60;
    label(ctx, 'slip+', right - 8, top + 12, 'right', colour.mode[0]);
    label(ctx, 'slip−', right - 8, bottom - 12, 'right', colour.mode[1]);
    label(ctx, 'stick+', right - 8, y - 14, 'right', colour.mode[2]);
    if (isWide)
      label(ctx, 'stick−', left + 8, y - 14, 'left', colour.mode[3]);
  }
}

// Pixels as a canvas of the size of another.
function enlarged(data, { width, height }) {
  const small = document.createElement('canvas');
  small.width = data.width;
  small.height = data.height;
  small.getContext('2d').putImageData(data, 0, 0);
  const large = document.createElement('canvas');
  large.width = width;
  large.height = height;
  large.getContext('2d').drawImage(small, 0, 0, width, height);
  return large;
}

// #rrggbb as four bytes.
const channels = (hex) => [1, 3, 5].map((i) =>
  parseInt(hex.slice(i, i + 2), 16)).concat(255);

const MAP = { columns: 200, rows: 120 };
const ENLARGED = 4; // times, for lines finer than a cell

export class SurfacePlane {
  constructor() {
    this.sheet = new Sheet('surface');
    this.image = document.createElement('canvas');
    this.begin();
  }

  begin() {
    this.ranges = { r: NONE, omega: NONE };
    this.key = '';
    this.sheet.isStale = true;
  }

  #range(name, rows, two) {
    let low = Infinity, high = -Infinity;
    for (const row of rows) {
      low = Math.min(low, row[AT[name]]);
      high = Math.max(high, row[AT[name]]);
    }
    if (name === 'omega') {
      low = Math.min(low, rows[rows.length - 1][AT.omega0]);
      high = Math.max(high, rows[rows.length - 1][AT.omega0]);
    }
    const size = Math.max(high - low, name === 'r' ? 0.012 : 0.06);
    // A two-fold nearby is worth a wider view.
    for (const point of two) {
      if (point[name] > low - 2 * size && point[name] < high + 2 * size) {
        low = Math.min(low, point[name]);
        high = Math.max(high, point[name]);
      }
    }
    this.ranges[name] = steady(this.ranges[name], low, high,
      name === 'r' ? 0.012 : 0.06);
    return this.ranges[name];
  }

  draw(motion, seconds, futures) {
    const ctx = this.sheet.clear();
    if (this.sheet.width < 10) return;
    const past = trail(motion, seconds);
    const seen = past.concat(...futures.map((future) => future.rows));
    const folds = motion.core.twoFolds();
    const near = folds.filter(({ r, omega }) =>
      Math.abs(r - motion.now[AT.r]) < 0.1 &&
      Math.abs(omega - motion.now[AT.omega]) < 0.3);
    const frame = new Frame(this.sheet, this.#range('r', seen, near),
      this.#range('omega', seen, near));
    this.frame = frame;
    frame.clip(ctx);
    this.#map(ctx, frame, motion);
    const y0 = frame.y(motion.now[AT.omega0]);
    path(ctx, [[frame.left, y0], [frame.right, y0]], colour.soft, 1, [2, 4]);
    const place = (row) => [frame.x(row[AT.r]), frame.y(row[AT.omega])];
    drawTrail(ctx, past, place);
    drawFutures(ctx, futures, place);
    this.#folds(ctx, frame, folds);
    const [x, y] = place(motion.now);
    drawNow(ctx, x, y, motion.now[AT.mode]);
    ctx.restore();
    if (y0 > frame.top + 14 && y0 < frame.bottom)
      label(ctx, 'ω = ω₀', frame.left + 6, y0 - 9);
    this.#key(ctx, frame);
    frame.axes(ctx, 'r', 'ω');
  }

  #map(ctx, frame, motion) {
    const { rangeX: x, rangeY: y } = frame;
    const key = `${x.low} ${x.high} ${y.low} ${y.high} ` +
      `${motion.now[AT.omega0]} ${motion.now[AT.r0]} ${motion.now[AT.force]} ` +
      `${motion.now[AT.torque]} ${colour.sliding}`;
    if (key !== this.key) {
      this.key = key;
      this.#paint(motion, x, y);
    }
    ctx.drawImage(this.image, frame.left, frame.top, frame.right - frame.left,
      frame.bottom - frame.top);
  }

  // The regions of a grid of points, with lines over the escaping ones.
  #paint(motion, x, y) {
    const { columns, rows } = MAP;
    const regions = motion.core.regions(x.low, x.high, columns, y.low, y.high,
      rows);
    const paint = REGION_COLOUR.map((name) => channels(colour[name]));
    const data = new ImageData(columns, rows), mask = new ImageData(columns,
      rows);
    for (let j = 0; j < rows; j++) {
      for (let i = 0; i < columns; i++) {
        const region = regions ? regions[j * columns + i] : 5;
        const at = 4 * ((rows - 1 - j) * columns + i);
        data.data.set(paint[region], at);
        mask.data[at + 3] = REGIONS[region] === 'escaping' ? 255 : 0;
      }
    }
    const { image } = this;
    image.width = columns * ENLARGED;
    image.height = rows * ENLARGED;
    const c = image.getContext('2d');
    c.drawImage(enlarged(mask, image), 0, 0);
    c.globalCompositeOperation = 'source-in';
    c.fillStyle = hatch(c);
    c.fillRect(0, 0, image.width, image.height);
    c.globalCompositeOperation = 'destination-over';
    c.drawImage(enlarged(data, image), 0, 0);
  }

  #folds(ctx, frame, folds) {
    for (const fold of folds) {
      const x = frame.x(fold.r), y = frame.y(fold.omega);
      if (x < frame.left || x > frame.right || y < frame.top ||
        y > frame.bottom) continue;
      path(ctx, [[x - 7, y], [x, y - 7], [x + 7, y], [x, y + 7], [x - 7, y]],
        colour.panel, 4);
      path(ctx, [[x - 7, y], [x, y - 7], [x + 7, y], [x, y + 7], [x - 7, y]],
        colour.ink, 1.8);
      label(ctx, 'two-fold', x + 12, y, 'left', colour.ink);
    }
  }

  #key(ctx, frame) {
    let x = frame.left + 8, y = frame.top + 12;
    ['sliding', 'escaping', 'crossing ↑', '↓'].forEach((name, i) => {
      const width = 27 + ctx.measureText(name).width;
      if (x + width > frame.right) {
        x = frame.left + 8;
        y += 17;
      }
      ctx.fillStyle = colour[REGION_COLOUR[i]];
      ctx.fillRect(x, y - 5, 14, 10);
      if (i === 1) {
        ctx.fillStyle = hatch(ctx);
        ctx.fillRect(x, y - 5, 14, 10);
      }
      ctx.strokeStyle = colour.soft;
      ctx.lineWidth = 0.8;
      ctx.strokeRect(x, y - 5, 14, 10);
      label(ctx, name, x + 18, y, 'left', colour.ink);
      x += width;
    });
  }
}
