// The futures of one instant: where each leads, how far the points that run
// along them have come, and the buttons that choose one.
import { short } from './decimal.mjs';
import { $, element } from './draw.mjs';

const SAMPLES = 240, EXITS = 16;
// Seconds of a round: at the start, moving, at the end; as in the picture of
// README.md.
const HOLD = 1, MOVE = 4.5, REST = 1.5;
export const WORDS = ['it slips one way', 'it slips the other way',
  'it rolls on', 'it rolls backwards', 'it is carried round'];

export class Fan {
  // choose(mode): goes on with a future.
  constructor(motion, choose) {
    Object.assign(this, { motion, choose });
    this.show(null);
  }

  // The futures of the step that ends at a tick, for so many seconds; or none.
  show(tick, seconds) {
    this.tick = tick;
    this.futures = tick === null ? []
      : this.motion.futures(tick, seconds, SAMPLES);
    this.exits = this.futures.filter(({ mode }) => mode === 2 || mode === 3)
      .flatMap(({ rows }) => this.motion.exits(rows, EXITS));
    this.began = performance.now();
    $('choices').replaceChildren();
    if (tick === null) return;
    $('choices').append(
      element('span', {}, `t = ${short(tick * this.motion.dt, 7)} s`),
      ...this.futures.map(({ mode }, at) => this.#button(mode, at + 1)));
  }

  #button(mode, number) {
    return element('button', { className: `mode mode${mode}`,
      onclick: () => this.choose(mode), title: `Continue with it (${number})` },
    `${number}  ${this.motion.core.modes[mode].replace('-', '−')}`,
    element('i', {}, `: ${WORDS[mode]}`));
  }

  // Sets the points that run along the futures to where they are now, or to
  // the end where nothing is to move. Returns: whether they move.
  run(now, isCalm) {
    const seconds = (now - this.began) / 1000 % (HOLD + MOVE + REST);
    const share = isCalm ? 1
      : Math.max(0, Math.min(1, (seconds - HOLD) / MOVE));
    for (const future of this.futures)
      future.head = future.rows[Math.round(share * (future.rows.length - 1))];
    return this.tick !== null && !isCalm;
  }
}
