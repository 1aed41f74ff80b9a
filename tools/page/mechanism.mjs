// The mechanism from above, to scale: turntable, disc, the slider on its rail
// with spring and wheel. A lens, which turns with the disc, shows the wheel on
// the turntable; there a few millimetres of motion are seen.
//
// In coordinates of the disc the wheel is at (r, d), rolls along (cos gamma,
// -sin gamma), and slips along (sin gamma, cos gamma), which is the direction
// of the force F.
import { AT } from './core.mjs';
import { Sheet, TAU, arrow, circle, colour, dot, fillShape, label, path,
  roundUp, text } from './draw.mjs';
import { short } from './decimal.mjs';

export class Mechanism {
  constructor() {
    this.sheet = new Sheet('mechanism');
    this.middle = NaN; // of the lens, along the rail [m]
  }

  // What does not change while a motion runs.
  begin(core) {
    for (const name of ['d', 'gamma', 'mu', 'kappa'])
      this[name] = core.get(name);
    this.size = Math.hypot(this.d, core.get('r'), core.get('r0')) || 1;
    this.reach = roundUp(this.size * 0.05);
    this.middle = NaN;
    this.sheet.isStale = true;
  }

  #lay(row) {
    const { width, height } = this.sheet;
    // Disc and lens in opposite corners, as large as they can be without
    // touching: (a - q)^2 + (b - q)^2 = q^2, with q the sum of their radii; and
    // in a flat sheet or a narrow one, as the disc has room.
    const a = width - 26, b = height - 24;
    const q = Math.min(a + b - Math.sqrt(2 * a * b), Math.min(a, b) / 1.2);
    this.radius = 0.6 * q;
    this.lens = 0.4 * q;
    this.scale = this.radius / (1.32 * this.size);
    this.x = this.radius + 12;
    this.y = this.radius + 10;
    this.lensX = width - this.lens - 14;
    this.lensY = height - this.lens - 12;
    const r = row[AT.r];
    if (!(Math.abs(r - this.middle) < 0.55 * this.reach))
      this.middle = Math.round(r / this.reach * 2) * this.reach / 2;
  }

  // A point of the disc on the sheet.
  #disc(row, x, y) {
    const c = Math.cos(row[AT.phi]), s = Math.sin(row[AT.phi]);
    return [this.x + this.scale * (c * x - s * y),
      this.y - this.scale * (s * x + c * y)];
  }

  draw(row, futures) {
    const ctx = this.sheet.clear();
    if (this.sheet.width < 10) return;
    this.#lay(row);
    this.#turntable(ctx, row);
    this.#top(ctx, row, futures);
    this.#closeUp(ctx, row, futures);
  }

  #turntable(ctx, row) {
    const { x, y, radius } = this;
    dot(ctx, x, y, radius, colour.faint);
    for (const share of [0.33, 0.66, 1])
      circle(ctx, x, y, radius * share, colour.line, 1);
    for (let i = 0; i < 48; i++) {
      const angle = -row[AT.table] + i * TAU / 48;
      const from = radius * (i % 12 === 0 ? 0.9 : 0.96);
      path(ctx, [[x + from * Math.cos(angle), y + from * Math.sin(angle)],
        [x + radius * Math.cos(angle), y + radius * Math.sin(angle)]],
      i === 0 ? colour.ink : colour.soft, i % 12 === 0 ? 1.6 : 0.8);
    }
  }

  #top(ctx, row, futures) {
    const { x, y, size } = this;
    const at = (a, b) => this.#disc(row, a, b);
    ctx.globalAlpha = 0.5;
    dot(ctx, x, y, this.scale * size * 1.13, colour.steel);
    ctx.globalAlpha = 1;
    circle(ctx, x, y, this.scale * size * 1.13, colour.soft, 1.4);
    const half = Math.sqrt(Math.max((size * 1.13) ** 2 - this.d ** 2, 0)) *
      0.96;
    path(ctx, [at(-half, this.d), at(half, this.d)], colour.panel, 7);
    path(ctx, [at(-half, this.d), at(half, this.d)], colour.soft, 1);
    path(ctx, [at(0, 0), at(0, this.d)], colour.soft, 1, [3, 4]);
    this.#spring(ctx, at, -half, row[AT.r], size * 0.035);
    this.#torque(ctx, row);
    dot(ctx, x, y, 4.5, colour.ink);
    const [px, py] = at(row[AT.r], this.d);
    dot(ctx, px, py, Math.max(11, this.scale * this.reach), colour.panel);
    this.#wheel(ctx, px, py, -row[AT.phi], 8, row[AT.mode]);
    for (const { head, mode } of futures)
      this.#wheel(ctx, ...this.#disc(head, head[AT.r], this.d), -head[AT.phi],
        8, mode, true);
    // The lens and what it shows.
    const ring = Math.max(14, this.scale * this.reach * 1.1);
    circle(ctx, px, py, ring, colour.ink, 1);
    const away = Math.hypot(this.lensX - px, this.lensY - py);
    if (away > ring + this.lens) {
      const c = (this.lensX - px) / away, s = (this.lensY - py) / away;
      path(ctx, [[px + c * ring, py + s * ring],
        [this.lensX - c * this.lens, this.lensY - s * this.lens]], colour.ink,
      0.8);
    }
  }

  #spring(ctx, at, from, to, size) {
    const points = [at(from, this.d)];
    const turns = 11;
    for (let i = 1; i < 2 * turns; i++)
      points.push(at(from + (to - from) * i / (2 * turns),
        this.d + (i % 2 ? size : -size)));
    points.push(at(to, this.d));
    path(ctx, points, colour.ink, 1.2);
  }

  // The torque by hand, about the axis.
  #torque(ctx, row) {
    const torque = row[AT.torque];
    if (torque === 0) return;
    const radius = this.radius * 0.16, turn = -Math.sign(torque) *
      Math.min(4.5, 0.8 + Math.abs(torque));
    this.#arc(ctx, this.x, this.y, radius, -Math.PI / 2, turn, colour.accent);
  }

  #arc(ctx, x, y, radius, from, turn, stroke) {
    ctx.beginPath();
    ctx.arc(x, y, radius, from, from + turn, turn < 0);
    ctx.strokeStyle = stroke;
    ctx.lineWidth = 2.5;
    ctx.stroke();
    const end = from + turn, way = end + Math.sign(turn) * Math.PI / 2;
    const ex = x + radius * Math.cos(end), ey = y + radius * Math.sin(end);
    arrow(ctx, ex - 6 * Math.cos(way), ey - 6 * Math.sin(way),
      ex + 6 * Math.cos(way), ey + 6 * Math.sin(way), stroke);
  }

  // angle: of the slider's rail on the sheet, clockwise.
  #wheel(ctx, x, y, angle, half, mode, isGhost = false) {
    ctx.save();
    ctx.translate(x, y);
    ctx.rotate(angle + this.gamma);
    ctx.beginPath();
    ctx.roundRect(-half, -half * 0.34, 2 * half, half * 0.68, half * 0.2);
    ctx.fillStyle = ctx.strokeStyle = colour.mode[mode];
    ctx.lineWidth = 2;
    if (isGhost) ctx.stroke();
    else ctx.fill();
    ctx.restore();
  }

  #closeUp(ctx, row, futures) {
    const { lensX: x, lensY: y, lens } = this;
    ctx.save();
    dot(ctx, x, y, lens + 5, colour.panel);
    dot(ctx, x, y, lens, colour.paper);
    ctx.clip();
    const k = lens / this.reach;
    this.#floor(ctx, row, k);
    this.#rail(ctx, k);
    for (const { head, mode } of futures)
      this.#wheel(ctx, x + k * (head[AT.r] - this.middle), y, 0, lens * 0.24,
        mode, true);
    const px = x + k * (row[AT.r] - this.middle);
    ctx.strokeStyle = colour.ink;
    ctx.lineWidth = 1.5;
    ctx.beginPath();
    ctx.roundRect(px - lens * 0.31, y - lens * 0.26, lens * 0.62, lens * 0.52,
      6);
    ctx.globalAlpha = 0.55;
    ctx.fillStyle = colour.steel;
    ctx.fill();
    ctx.globalAlpha = 1;
    ctx.stroke();
    this.#wheel(ctx, px, y, 0, lens * 0.24, row[AT.mode]);
    fillShape(ctx, [[px - 4, y + lens * 0.26], [px + 4, y + lens * 0.26],
      [px, y + lens * 0.34]], colour.ink);
    ctx.room.disc = { x, y, radius: lens };
    this.#forces(ctx, row, px, y);
    this.#railNames(ctx, k);
    ctx.room.disc = null;
    ctx.restore();
    circle(ctx, x, y, lens, colour.ink, 1.2);
    this.#scaleBar(ctx, k);
  }

  // The turntable under the wheel: a lattice of its own points.
  #floor(ctx, row, k) {
    const { lensX, lensY, middle, d, reach } = this;
    const angle = row[AT.table] - row[AT.phi], space = reach / 4;
    const c = Math.cos(angle), s = Math.sin(angle);
    // The lens' middle in coordinates of the turntable.
    const cx = c * middle + s * d, cy = -s * middle + c * d;
    ctx.fillStyle = colour.soft;
    const n = 7;
    for (let i = -n; i <= n; i++) {
      for (let j = -n; j <= n; j++) {
        const a = (Math.round(cx / space) + i) * space;
        const b = (Math.round(cy / space) + j) * space;
        const u = c * a - s * b - middle, w = s * a + c * b - d;
        const isBold = Math.round((a + b) / space) % 4 === 0;
        ctx.globalAlpha = isBold ? 0.75 : 0.3;
        const half = isBold ? 1.8 : 1.2;
        ctx.fillRect(lensX + k * u - half, lensY - k * w - half, 2 * half,
          2 * half);
      }
    }
    ctx.globalAlpha = 1;
  }

  #rail(ctx, k) {
    const { lensX: x, lensY: y, lens, middle, reach } = this;
    path(ctx, [[x - lens, y], [x + lens, y]], colour.soft, 1);
    const step = reach / 5;
    for (let i = Math.ceil((middle - reach) / step); i * step < middle + reach;
      i++) {
      const at = x + k * (i * step - middle);
      const isLong = i % 5 === 0;
      path(ctx, [[at, y + lens * 0.32], [at, y + lens * (isLong ? 0.4 : 0.36)]],
        colour.ink, isLong ? 1.4 : 0.8);
    }
  }

  // Of the long marks; behind the forces, which name themselves where they are.
  #railNames(ctx, k) {
    const { lensX: x, lensY: y, lens, middle, reach } = this;
    for (let i = Math.ceil((middle - reach) / reach);
      i * reach < middle + reach; i++) {
      const at = x + k * (i * reach - middle);
      if (Math.abs(at - x) < lens * 0.75)
        label(ctx, `${short(i * reach)} m`, [0.54, 0.7, 0.84].map(
          (part) => [at, y + lens * part, 'center']));
    }
  }

  // F of mu is as long as 0.6 of the lens; M of kappa mu turns by 3/8.
  #forces(ctx, row, x, y) {
    const { lens, gamma, mu, kappa } = this;
    if (!(mu > 0)) return;
    const size = 0.6 * lens * row[AT.F] / mu;
    arrow(ctx, x, y, x + size * Math.sin(gamma), y - size * Math.cos(gamma),
      colour.ink);
    const tip = size + Math.sign(size) * 10;
    if (Math.abs(size) > 14)
      label(ctx, 'F', [[tip, 0], [0.6 * size, 12], [0.6 * size, -12]]
        .map(([a, b]) => [x + a * Math.sin(gamma) + b * Math.cos(gamma),
          y - a * Math.cos(gamma) + b * Math.sin(gamma), 'center']),
      colour.ink);
    const turn = kappa > 0 ? -0.75 * Math.PI * row[AT.M] / (kappa * mu) : 0;
    if (Math.abs(turn) > 0.15) {
      this.#arc(ctx, x, y, lens * 0.4, -0.3, turn, colour.soft);
      label(ctx, 'M', [0.5, 0.3, 0.28].flatMap((away) =>
        [0.5, 0.3, 0.7].map((part) => [away * lens, -0.3 + part * turn]))
        .map(([away, at]) => [x + away * Math.cos(at),
          y + away * Math.sin(at), 'center']));
    }
    if (row[AT.force] !== 0)
      arrow(ctx, x, y - lens * 0.33, x + Math.sign(row[AT.force]) *
        Math.min(0.7, 0.15 + 0.1 * Math.abs(row[AT.force])) * lens,
      y - lens * 0.33, colour.accent, 3);
  }

  #scaleBar(ctx, k) {
    const long = roundUp(0.2 * this.size);
    const x = 12, y = this.sheet.height - 12;
    path(ctx, [[x, y - 4], [x, y], [x + long * this.scale, y],
      [x + long * this.scale, y - 4]], colour.soft, 1);
    label(ctx, `${short(long)} m`, [[x + long * this.scale + 6, y - 3]]);
    text(ctx, `${short(k / this.scale, 2)} times as large`, this.lensX +
      this.lens, this.lensY - this.lens - 8, 'right');
  }

  // What a pointer takes hold of, and where: the slider in the lens or on the
  // disc, or the disc itself.
  hold({ x, y }, row) {
    if (Math.hypot(x - this.lensX, y - this.lensY) < this.lens)
      return { part: 'slider', lens: true };
    const [px, py] = this.#disc(row, row[AT.r], this.d);
    if (Math.hypot(x - px, y - py) < 24) return { part: 'slider' };
    if (Math.hypot(x - this.x, y - this.y) < this.radius)
      return { part: 'disc' };
    return null;
  }

  // The r that a pointer means.
  along({ x, y }, row, isInLens) {
    if (isInLens)
      return this.middle + (x - this.lensX) * this.reach / this.lens;
    const a = (x - this.x) / this.scale, b = (this.y - y) / this.scale;
    return Math.cos(row[AT.phi]) * a + Math.sin(row[AT.phi]) * b;
  }

  angle({ x, y }) { return Math.atan2(this.y - y, x - this.x); }
}
