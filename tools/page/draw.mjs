// What all drawings share: canvases that are sharp on any screen, the colours
// of the style, ranges and words.

// An element by its id.
export const $ = (id) => document.getElementById(id);

// A new one.
export function element(tag, properties = {}, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}

export const TAU = 2 * Math.PI;
export const FONT = '12px system-ui, -apple-system, "Segoe UI", "Noto Sans", ' +
  '"DejaVu Sans", sans-serif';

export const colour = {};
export function readColours() {
  const style = getComputedStyle(document.documentElement);
  for (const name of ['paper', 'panel', 'ink', 'soft', 'line', 'faint',
    'accent', 'sliding', 'escaping', 'up', 'down', 'escaping-lines',
    'up-lines', 'down-lines', 'steel'])
    colour[name] = style.getPropertyValue(`--${name}`).trim();
  colour.mode = ['slip-plus', 'slip-minus', 'stick-plus', 'stick-minus',
    'pinned'].map((name) => style.getPropertyValue(`--${name}`).trim());
}

// A canvas with its size in CSS pixels.
export class Sheet {
  constructor(id) {
    this.canvas = $(id);
    this.ctx = this.canvas.getContext('2d');
    this.width = this.height = 0;
    new ResizeObserver(() => this.fit()).observe(this.canvas);
    this.fit();
  }

  fit() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const ratio = window.devicePixelRatio || 1;
    this.width = width;
    this.height = height;
    this.canvas.width = Math.round(width * ratio);
    this.canvas.height = Math.round(height * ratio);
    this.ratio = ratio;
    this.isStale = true;
  }

  clear() {
    const { ctx } = this;
    ctx.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    ctx.clearRect(0, 0, this.width, this.height);
    ctx.font = FONT;
    ctx.lineJoin = ctx.lineCap = 'round';
    ctx.textAlign = 'left';
    ctx.textBaseline = 'middle';
    ctx.words = [];
    ctx.room = { left: 0, right: this.width, top: 0, bottom: this.height,
      disc: null };
    return ctx;
  }

  // Where a pointer is on it.
  place(event) {
    const box = this.canvas.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }
}

// The next of 1, 2, 5 times a power of ten that is not less.
export function roundUp(x) {
  if (!(x > 0)) return 1;
  const power = 10 ** Math.floor(Math.log10(x));
  return [1, 2, 5, 10].find((n) => n * power >= x * (1 - 1e-9)) * power;
}

// About so many round numbers between two.
export function ticks(low, high, count) {
  const step = roundUp((high - low) / count);
  const found = [];
  const last = Math.floor(high / step + 1e-9);
  for (let i = Math.ceil(low / step - 1e-9); i <= last; i++)
    found.push(Number((i * step).toPrecision(12)));
  return found;
}

// A range that holds [low, high] and changes in round steps, so that axes
// stand still while the motion goes on.
export function steady(range, low, high, least) {
  const size = Math.max(high - low, least);
  const isOut = low < range.low || high > range.high;
  if (!isOut && size > (range.high - range.low) / 4) return range;
  const step = roundUp(size) / 5;
  const middle = (low + high) / 2, half = 0.62 * size;
  return { low: Math.floor((middle - half) / step) * step,
    high: Math.ceil((middle + half) / step) * step };
}

// The range of some numbers.
export const extent = (numbers) => numbers.reduce(({ low, high }, x) =>
  ({ low: Math.min(low, x), high: Math.max(high, x) }),
{ low: Infinity, high: -Infinity });

// What words take on the sheet.
function boxOf(ctx, words, x, y) {
  const size = ctx.measureText(words);
  return { words, left: x - size.actualBoundingBoxLeft,
    right: x + size.actualBoundingBoxRight,
    top: y - size.actualBoundingBoxAscent,
    bottom: y + size.actualBoundingBoxDescent };
}

const GAP = 3; // least space between words in a row

const isInDisc = ({ left, right, top, bottom }, { x, y, radius }) =>
  Math.hypot(Math.max(x - left, right - x), Math.max(y - top, bottom - y)) <=
  radius;
const isWithin = (box, room) => box.left >= room.left &&
  box.right <= room.right && box.top >= room.top &&
  box.bottom <= room.bottom && (!room.disc || isInDisc(box, room.disc));
const isApart = (a, b) => a.right + GAP <= b.left || b.right + GAP <= a.left ||
  a.bottom <= b.top || b.bottom <= a.top;

// Words at the first of some places, [x, y, align] each, where they lie on no
// other words and within the room; nowhere, if there is none. hasHalo: they are
// legible on whatever is behind them.
function place(ctx, words, places, fill, hasHalo) {
  for (const [x, y, align = 'left'] of places) {
    ctx.textAlign = align;
    const box = boxOf(ctx, words, x, y);
    if (!isWithin(box, ctx.room) ||
      !ctx.words.every((other) => isApart(box, other))) continue;
    ctx.words.push(box);
    if (hasHalo) {
      ctx.strokeStyle = colour.panel;
      ctx.lineWidth = 3.5;
      ctx.strokeText(words, x, y);
    }
    ctx.fillStyle = fill;
    ctx.fillText(words, x, y);
    return;
  }
}

export function text(ctx, words, x, y, align = 'left', fill = colour.soft) {
  place(ctx, words, [[x, y, align]], fill, false);
}

export function label(ctx, words, places, fill = colour.soft) {
  place(ctx, words, places, fill, true);
}

export function dot(ctx, x, y, radius, fill) {
  ctx.beginPath();
  ctx.arc(x, y, radius, 0, TAU);
  ctx.fillStyle = fill;
  ctx.fill();
}

export function circle(ctx, x, y, radius, stroke, width) {
  ctx.beginPath();
  ctx.arc(x, y, radius, 0, TAU);
  ctx.strokeStyle = stroke;
  ctx.lineWidth = width;
  ctx.stroke();
}

function trace(ctx, points) {
  ctx.beginPath();
  points.forEach(([x, y], i) => (i ? ctx.lineTo(x, y) : ctx.moveTo(x, y)));
}

// Fills what lies within the points.
export function fillShape(ctx, points, fill) {
  trace(ctx, points);
  ctx.fillStyle = fill;
  ctx.fill();
}

// Until the next restore nothing is drawn outside of a rectangle.
export function clip(ctx, ...box) {
  ctx.save();
  ctx.beginPath();
  ctx.rect(...box);
  ctx.clip();
}

export function path(ctx, points, stroke, width, dash = []) {
  trace(ctx, points);
  ctx.strokeStyle = stroke;
  ctx.lineWidth = width;
  ctx.setLineDash(dash);
  ctx.stroke();
  ctx.setLineDash([]);
}

// An arrow; nothing where it would be shorter than its head.
export function arrow(ctx, x0, y0, x1, y1, stroke, width = 2.5) {
  const length = Math.hypot(x1 - x0, y1 - y0), head = 3.2 * width;
  if (length < head) return;
  const c = (x1 - x0) / length, s = (y1 - y0) / length;
  path(ctx, [[x0, y0], [x1 - c * head * 0.8, y1 - s * head * 0.8]], stroke,
    width);
  fillShape(ctx, [[x1, y1],
    [x1 - c * head - s * head * 0.5, y1 - s * head + c * head * 0.5],
    [x1 - c * head + s * head * 0.5, y1 - s * head - c * head * 0.5]], stroke);
}
