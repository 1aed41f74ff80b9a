// The regions of the surface h = 0 as they are drawn: each by a colour and a
// pattern, in a map over (r, omega) that is kept until it changes, and in the
// key that explains them.
import { AT } from './core.mjs';
import { colour, path, text } from './draw.mjs';

const NO_REGION = 5; // the law has none, or the point has no speed v
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

// Where the regions are explained, above a drawing: in lines as they fit.
// Returns: the keys, and where the last line is.
export function keysOf(ctx, width) {
  let x = 12, y = 14;
  const keys = ['sliding', 'escaping', 'crossing ↑', 'crossing ↓']
    .map((name, region) => {
      const size = 22 + ctx.measureText(name).width;
      if (x + size > width - 8) {
        x = 12;
        y += 19;
      }
      const key = { name, region, x, y };
      x += size + Math.min(16, width / 36);
      return key;
    });
  return { keys, end: y };
}

export function drawKeys(ctx, keys, ratio) {
  for (const { name, region, x, y } of keys) {
    ctx.save();
    ctx.translate(x, y - 7.75); // two whole arrowheads
    fillRegion(ctx, region, ratio, 0, 1.75, 17, 12);
    ctx.strokeStyle = colour.soft;
    ctx.lineWidth = 0.8;
    ctx.strokeRect(0, 1.75, 17, 12);
    ctx.restore();
    text(ctx, name, x + 22, y, 'left', colour.ink);
  }
}

// #rrggbb as four bytes.
const channels = (hex) => [1, 3, 5].map((i) =>
  parseInt(hex.slice(i, i + 2), 16)).concat(255);

const MAP = { columns: 200, rows: 120 };
export const FLOOR = 420; // pixels of the map along each side

// The map over ranges of r and omega. lacks: why it has no regions, or null.
export class RegionMap {
  constructor() {
    for (const name of ['image', 'layer', 'small'])
      this[name] = document.createElement('canvas');
    this.small.width = MAP.columns;
    this.small.height = MAP.rows;
    for (const sheet of [this.image, this.layer])
      sheet.width = sheet.height = FLOOR;
    this.lacks = null;
  }

  // Returns: the image, painted anew where that is needed.
  of(motion, x, y) {
    const { now } = motion;
    const key = [x.low, x.high, y.low, y.high, now[AT.omega0], now[AT.r0],
      now[AT.force], now[AT.torque], motion.begun, colour.sliding].join();
    if (key !== this.key) this.#paint(motion, x, y);
    this.key = key;
    return this.image;
  }

  // Why the map has no regions. Where sin(gamma) is 0 the surface has them, but
  // its points are not known by r and omega.
  #why({ core }) {
    return Math.abs(Math.sin(core.get('gamma'))) < core.c.least_sine()
      ? 'here v does not follow from r and ω' : 'this law has no stick';
  }

  // The regions of a grid of points, and over them the pattern of each.
  #paint(motion, x, y) {
    const { columns, rows } = MAP, { image, layer, small } = this;
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
      to.drawImage(small, 0, 0, FLOOR, FLOOR);
    };
    this.lacks = regions?.some((region) => region < NO_REGION) ? null
      : this.#why(motion);
    const paints = REGION_COLOUR.map((name) => channels(colour[name]));
    enlarge(c, (region) => paints[region]);
    for (const region of [1, 2, 3]) {
      if (!regions?.includes(region)) continue;
      cover.globalCompositeOperation = 'copy';
      enlarge(cover, (at) => [0, 0, 0, at === region ? 255 : 0]);
      cover.globalCompositeOperation = 'source-in';
      cover.fillStyle = pattern(cover, region, 1);
      cover.fillRect(0, 0, FLOOR, FLOOR);
      c.drawImage(layer, 0, 0);
    }
  }
}
