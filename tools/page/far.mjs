// Work that takes longer than a frame: how much of it is done, the time left as
// if the rest went at the mean speed so far, and a button that ends it.
import { short } from './decimal.mjs';
import { $ } from './draw.mjs';

const PATIENCE = 0.5; // [s] before anything is shown
const UNITS = [[31557600, 'years'], [86400, 'days'], [3600, 'h'], [60, 'min'],
  [1, 's']];

function inWords(seconds) {
  const [size, unit] = UNITS.find(([least]) => seconds >= 2 * least) ??
    UNITS[UNITS.length - 1];
  return `${short(Math.ceil(seconds / size), 4)} ${unit} left`;
}

export class Far {
  constructor(stop) {
    Object.assign(this, { row: $('row'), done: $('done'), left: $('left') });
    $('stop').onclick = stop;
  }

  // Work with a goal has come to `at`. Another goal, or a way back, is other
  // work, which begins here.
  tell(what, at, goal) {
    const now = performance.now();
    if (goal !== this.goal || !(at >= this.at))
      Object.assign(this, { goal, from: at, began: now });
    this.at = at;
    const share = (at - this.from) / (goal - this.from);
    const seconds = (now - this.began) / 1000;
    const isLong = share > 0 && seconds > PATIENCE;
    this.row.classList.toggle('far', isLong);
    if (!isLong) return;
    this.done.value = share;
    this.left.textContent = `${what}, ${inWords(seconds / share - seconds)}`;
  }

  end() {
    this.goal = null;
    this.row.classList.remove('far');
  }
}
