// Two planes on the clock of the motion: the slip (g, h), and the surface h = 0
// over (r, omega) with the regions of its points.
import { AT } from './core.mjs';
import { Frame, Sheet, clip, colour, dot, extent, label, path, steady, text }
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

// The path of rows up to the present, each piece in the colour of its mode, and
// the futures.
function drawMotion(ctx, rows, futures, place) {
  for (let i = 1; i < rows.length;) {
    const mode = rows[i][AT.mode], points = [place(rows[i - 1])];
    while (i < rows.length && rows[i][AT.mode] === mode)
      points.push(place(rows[i++]));
    path(ctx, points, colour.mode[mode], 1.8);
  }
  for (const { mode, rows: ahead } of futures) {
    const points = ahead.map(place);
    path(ctx, points, colour.mode[mode], 1.8);
    dot(ctx, ...points[points.length - 1], 4, colour.mode[mode]);
  }
  const now = rows[rows.length - 1];
  dot(ctx, ...place(now), 6.5, colour.panel);
  dot(ctx, ...place(now), 4.5, colour.mode[now[AT.mode]]);
}

const NO_REGION = 5; // the law has none, or the point has no speed v
const hasAny = (regions) => regions?.some((region) => region < NO_REGION);
const REGION_COLOUR = ['sliding', 'escaping', 'up', 'down', 'line', 'panel'];

// What is drawn over the colour of a region, so that it is known without it, as
// lines in a tile: nothing over sliding points, stripes over escaping ones, and
// arrowheads where the slip crosses h = 0, upwards or downwards.
const TILE = 16;
const stripes = [0, 1, 2, 3, 4, 5].map((i) => i * TILE / 3)
  .map((sum) => [[-1, sum + 1], [sum + 1, -1]]);
const heads = (from, to) => [[2, 0], [10, 8]].map(([x, y]) =>
  [[x, y + from], [x + 2.25, y + to], [x + 4.5, y + from]]);
const PATTERNS = [[], stripes, heads(5, 2.5), heads(2.5, 5)];

// A pattern in the units of a sheet that has `ratio` pixels for each.
const made = new Map();
function pattern(ctx, region, ratio) {
  const stroke = colour[`${REGION_COLOUR[region]}-lines`];
  const key = `${region} ${ratio} ${stroke}`;
  if (!made.has(key)) {
    const tile = document.createElement('canvas');
    tile.width = tile.height = Math.round(TILE * ratio);
    const c = tile.getContext('2d');
    c.scale(tile.width / TILE, tile.width / TILE);
    c.lineCap = 'round';
    for (const points of PATTERNS[region]) path(c, points, stroke, 1.1);
    made.set(key, tile);
  }
  const tile = made.get(key), filled = ctx.createPattern(tile, 'repeat');
  filled.setTransform(new DOMMatrix().scale(TILE / tile.width));
  return filled;
}

// A rectangle as the points of a region are drawn.
function fillRegion(ctx, region, ratio, ...box) {
  ctx.fillStyle = colour[REGION_COLOUR[region]];
  ctx.fillRect(...box);
  if (!PATTERNS[region]?.length) return;
  ctx.fillStyle = pattern(ctx, region, ratio);
  ctx.fillRect(...box);
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
    const { low, high } = extent([0, ...rows.map((row) => row[AT[name]])]);
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
    clip(ctx, ...frame.box);
    this.#halves(ctx, frame);
    const canStick = this.#line(ctx, frame, motion);
    path(ctx, [[frame.x(0), frame.top], [frame.x(0), frame.bottom]],
      colour.line, 1);
    drawMotion(ctx, past, futures, (row) =>
      [frame.x(row[AT.g]), frame.y(row[AT.h])]);
    ctx.restore();
    frame.axes(ctx, 'g', 'h');
    ctx.room = frame;
    this.#names(ctx, frame, canStick);
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

  // h = 0, by the regions that it has at the present r. Returns: whether it has
  // any.
  #line(ctx, frame, motion) {
    const count = Math.max(2, Math.round((frame.right - frame.left) / 3));
    const { low, high } = frame.rangeX;
    const regions = motion.core.regionsAt(motion.now[AT.r], low, high, count);
    const width = (frame.right - frame.left) / count, y = frame.y(0);
    path(ctx, [[frame.left, y], [frame.right, y]], colour.line, 1);
    if (!hasAny(regions)) return false;
    for (let i = 0; i < count; i++)
      if (regions[i] <= 1) fillRegion(ctx, regions[i], this.sheet.ratio,
        frame.left + i * width, y - 5, width + 0.6, 10);
    path(ctx, [[frame.left, y], [frame.right, y]], colour.soft, 1);
    return true;
  }

  #names(ctx, frame, canStick) {
    const { left, right, top, bottom } = frame, y = frame.y(0);
    const end = right - 8;
    label(ctx, 'slip+', [[end, top + 12, 'right']], colour.mode[0]);
    label(ctx, 'slip−', [[end, bottom - 12, 'right']], colour.mode[1]);
    if (!canStick) return;
    label(ctx, 'stick+', [y - 14, y + 14].map((at) => [end, at, 'right']),
      colour.mode[2]);
    if (frame.x(0) - left > 60)
      label(ctx, 'stick−', [y - 14, y + 14].map((at) => [left + 8, at]),
        colour.mode[3]);
  }
}

// #rrggbb as four bytes.
const channels = (hex) => [1, 3, 5].map((i) =>
  parseInt(hex.slice(i, i + 2), 16)).concat(255);

const MAP = { columns: 200, rows: 120 };

export class SurfacePlane {
  constructor() {
    this.sheet = new Sheet('surface');
    for (const name of ['image', 'layer', 'small'])
      this[name] = document.createElement('canvas');
    this.small.width = MAP.columns;
    this.small.height = MAP.rows;
    this.begin();
  }

  begin() {
    this.ranges = { r: NONE, omega: NONE };
    this.key = '';
    this.sheet.isStale = true;
  }

  #range(name, rows, two) {
    const least = name === 'r' ? 0.012 : 0.06;
    const values = rows.map((row) => row[AT[name]]);
    if (name === 'omega') values.push(rows[rows.length - 1][AT.omega0]);
    let { low, high } = extent(values);
    const size = Math.max(high - low, least);
    // A two-fold nearby is worth a wider view.
    for (const { [name]: x } of two)
      if (x > low - 2 * size && x < high + 2 * size)
        ({ low, high } = extent([low, high, x]));
    this.ranges[name] = steady(this.ranges[name], low, high, least);
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
    const keys = this.#keys(ctx);
    const frame = new Frame(this.sheet, this.#range('r', seen, near),
      this.#range('omega', seen, near), keys[keys.length - 1].y + 15);
    this.frame = frame;
    clip(ctx, ...frame.box);
    this.#map(ctx, frame, motion);
    const y0 = frame.y(motion.now[AT.omega0]);
    path(ctx, [[frame.left, y0], [frame.right, y0]], colour.soft, 1, [2, 4]);
    const marks = this.#folds(ctx, frame, folds);
    drawMotion(ctx, past, futures, (row) =>
      [frame.x(row[AT.r]), frame.y(row[AT.omega])]);
    ctx.restore();
    for (const key of keys) this.#key(ctx, key);
    frame.axes(ctx, 'r', 'ω');
    ctx.room = frame;
    if (this.lacks) label(ctx, this.lacks, [[(frame.left + frame.right) / 2,
      frame.bottom - 14, 'center']]);
    for (const [a, b] of marks)
      label(ctx, 'two-fold', [[a + 10, b - 11], [a - 10, b - 11, 'right'],
        [a + 10, b + 11], [a - 10, b + 11, 'right']], colour.ink);
    if (y0 > frame.top && y0 < frame.bottom)
      label(ctx, 'ω = ω₀', [[frame.right - 6, y0 - 9, 'right'],
        [frame.left + 6, y0 - 9], [frame.right - 6, y0 + 10, 'right']],
      colour.ink);
  }

  #map(ctx, frame, motion) {
    const { rangeX: x, rangeY: y } = frame;
    const { ratio } = this.sheet;
    const width = Math.round((frame.right - frame.left) * ratio);
    const height = Math.round((frame.bottom - frame.top) * ratio);
    if (width < 1 || height < 1) return;
    const key = `${width} ${height} ${x.low} ${x.high} ${y.low} ${y.high} ` +
      `${motion.now[AT.omega0]} ${motion.now[AT.r0]} ${motion.now[AT.force]} ` +
      `${motion.now[AT.torque]} ${colour.sliding}`;
    if (key !== this.key) {
      this.key = key;
      this.image.width = this.layer.width = width;
      this.image.height = this.layer.height = height;
      this.#paint(motion, x, y);
    }
    ctx.drawImage(this.image, ...frame.box);
  }

  // Why the map has no regions. Where sin(gamma) is 0 the surface has them, but
  // its points are not known by r and omega.
  #why({ core, now }) {
    return hasAny(core.regionsAt(now[AT.r], -1, 1, 2))
      ? 'here v does not follow from r and ω' : 'this law has no stick';
  }

  // The regions of a grid of points, and over them the pattern of each.
  #paint(motion, x, y) {
    const { columns, rows } = MAP, { image, layer, small } = this;
    const { width, height } = image, ratio = this.sheet.ratio;
    const regions = motion.core.regions(x.low, x.high, columns, y.low, y.high,
      rows);
    const c = image.getContext('2d'), cover = layer.getContext('2d');
    const from = small.getContext('2d');
    // The cells as pixels, then as large as the map.
    const enlarge = (to, paint) => {
      const data = new ImageData(columns, rows);
      for (let j = 0; j < rows; j++)
        for (let i = 0; i < columns; i++)
          data.data.set(paint(regions ? regions[j * columns + i] : NO_REGION),
            4 * ((rows - 1 - j) * columns + i));
      from.putImageData(data, 0, 0);
      to.drawImage(small, 0, 0, width, height);
    };
    this.lacks = hasAny(regions) ? null : this.#why(motion);
    const paints = REGION_COLOUR.map((name) => channels(colour[name]));
    enlarge(c, (region) => paints[region]);
    for (const region of [1, 2, 3]) {
      if (!regions?.includes(region)) continue;
      cover.setTransform(1, 0, 0, 1, 0, 0);
      cover.globalCompositeOperation = 'copy';
      enlarge(cover, (at) => [0, 0, 0, at === region ? 255 : 0]);
      cover.globalCompositeOperation = 'source-in';
      cover.scale(ratio, ratio);
      cover.fillStyle = pattern(cover, region, ratio);
      cover.fillRect(0, 0, width, height);
      c.drawImage(layer, 0, 0);
    }
  }

  // Returns: where they are.
  #folds(ctx, frame, folds) {
    const places = folds.map((fold) => [frame.x(fold.r), frame.y(fold.omega)])
      .filter(([x, y]) => x >= frame.left && x <= frame.right &&
        y >= frame.top && y <= frame.bottom);
    for (const [x, y] of places) {
      const corners = [[x - 7, y], [x, y - 7], [x + 7, y], [x, y + 7],
        [x - 7, y]];
      path(ctx, corners, colour.panel, 4);
      path(ctx, corners, colour.ink, 1.8);
    }
    return places;
  }

  // Where the regions are explained, above the map: in lines as they fit.
  #keys(ctx) {
    let x = 12, y = 14;
    return ['sliding', 'escaping', 'crossing ↑', 'crossing ↓']
      .map((name, region) => {
        const width = 22 + ctx.measureText(name).width;
        if (x + width > this.sheet.width - 8) {
          x = 12;
          y += 19;
        }
        const key = { name, region, x, y };
        x += width + Math.min(16, this.sheet.width / 36);
        return key;
      });
  }

  #key(ctx, { name, region, x, y }) {
    ctx.save();
    ctx.translate(x, y - 7.75); // two whole arrowheads
    fillRegion(ctx, region, this.sheet.ratio, 0, 1.75, 17, 12);
    ctx.strokeStyle = colour.soft;
    ctx.lineWidth = 0.8;
    ctx.strokeRect(0, 1.75, 17, 12);
    ctx.restore();
    text(ctx, name, x + 22, y, 'left', colour.ink);
  }
}
