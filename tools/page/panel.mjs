// The set-up as sliders, fields and lists, all of them from the core's tables.
// A slider spans a neighbourhood of the scene's value, within the range of the
// core; the field beside it takes the whole range. Where the core refuses, why
// is told and every field shows what holds: the motion goes on as it was.
import { rangeOf } from './core.mjs';
import { decimal } from './decimal.mjs';
import { $, element } from './draw.mjs';

const STEPS = 400;
const LISTS = { law: 'force and moment of the tyre over its slip',
  rule: 'which one of several possible modes the motion takes',
  rest: 'force and moment that are possible at h = g = 0' };
const SPREAD = { r: 0.2, omega: 1, h: 0.5, v: 0.5 };

// Position 0 to STEPS and back, over what the slider spans.
export function spanOf({ low, high, spread }, base) {
  if (high - low <= 10)
    return { to: (p) => low + (high - low) * p / STEPS,
      from: (x) => (x - low) / (high - low) * STEPS };
  if (low >= 0 && base > 0 && spread === undefined) {
    const a = Math.max(low, base / 10) || base / 10;
    const b = Math.min(high, base * 10);
    return { to: (p) => a * (b / a) ** (p / STEPS),
      from: (x) => Math.log(Math.max(x, a) / a) / Math.log(b / a) * STEPS };
  }
  const half = spread ?? Math.max(1, Math.abs(base));
  const a = Math.max(low, base - half), b = Math.min(high, base + half);
  return { to: (p) => a + (b - a) * p / STEPS,
    from: (x) => (x - a) / (b - a) * STEPS };
}

// Three digits more than the slider's step resolves.
const rounded = (x) => Number(x.toPrecision(6));
// What a field shows until it is entered.
const brief = (x) => decimal(rounded(x));

export class Panel {
  // change(name, value): informs the page. Returns: null or a refusal.
  // refuse(words): tells one, or that there is none.
  constructor(core, change, refuse) {
    this.core = core;
    this.change = change;
    this.refuse = refuse;
    this.lists = $('lists');
    this.numbers = $('numbers');
    this.starts = $('starts');
    this.refusal = $('refusal');
    this.rows = {};
  }

  // The set-up in the core, of a scene whose own values are given: what its law
  // and rule use.
  show(own) {
    const { core } = this;
    this.own = own;
    this.rows = {};
    this.lists.replaceChildren();
    for (const [name, words] of Object.entries(core.lists)) {
      const select = element('select', { id: `list-${name}`, onchange: () =>
        this.#tell(name, select.selectedIndex) },
      ...words.map((word) => element('option', {}, word)));
      const title = element('span', { title: LISTS[name] }, name);
      const label = element('label', {}, title, select);
      this.rows[name] = { title, label, list: select };
      this.lists.append(label);
    }
    if (!core.unused('seed'))
      this.#number(core.ranges.get('seed'), this.lists, true);
    this.numbers.replaceChildren();
    this.starts.replaceChildren();
    for (const parameter of core.parameters)
      if (!core.unused(parameter.name)) this.#number(parameter, this.numbers);
    for (const name of ['r', 'omega', core.get('v is given') ? 'v' : 'h'])
      this.#number({ ...core.ranges.get(name), spread: SPREAD[name] },
        this.starts);
    this.mark();
  }

  #number(about, place, isPlain = false) {
    const { name, low, high } = about;
    const unit = about.unit === '1' ? '' : about.unit;
    const range = `${name}: ${about.words}; ${low} to ${high} ${unit}`;
    const title = element('span', { title: range }, name);
    const field = element('input', { type: 'text', inputMode: 'decimal',
      title: range, autocomplete: 'off',
      onfocus: () => { field.value = decimal(this.core.get(name)); },
      onkeydown: ({ key }) => { // what was typed is not taken
        if (key === 'Escape') field.value = decimal(this.core.get(name));
      },
      onblur: () => { field.value = brief(this.core.get(name)); },
      onchange: () => this.#read(name, field) });
    field.setAttribute('aria-label', range);
    if (isPlain) {
      this.rows[name] = { title, field };
      place.append(title, field);
      return;
    }
    const hasOwn = about.laws === undefined ||
      this.core.needs(about, this.own.law);
    const span = spanOf(about, hasOwn ? this.own[name] : about.there);
    const slider = element('input', { type: 'range', min: 0, max: STEPS,
      step: 1, title: range, oninput: () =>
        this.#tell(name, rounded(span.to(Number(slider.value)))) });
    slider.setAttribute('aria-label', range);
    this.rows[name] = { title, field, slider, span };
    place.append(title, slider, field, element('span', { className: 'unit' },
      unit));
  }

  // What was typed is read as the command line reads it.
  #read(name, field) {
    const text = field.value.trim(), value = this.core.number(text);
    if (typeof value === 'number') this.#tell(name, value);
    else this.#end(name, `${name}: '${text}' ${value}; it takes ` +
      rangeOf(this.core.ranges.get(name)));
  }

  #tell(name, value) { this.#end(name, this.change(name, value)); }

  #end(name, refusal) {
    const isList = this.rows[name].list !== undefined;
    this.refuse(refusal);
    if (isList && !refusal) {
      this.show(this.own);
      this.rows[name].list.focus();
    } else this.mark();
  }

  say(refusal) {
    this.refusal.hidden = !refusal;
    this.refusal.textContent = refusal ?? '';
  }

  // All fields show what holds, and what of it differs from the scene.
  mark() {
    const { core } = this;
    let count = 0;
    for (const [name, row] of Object.entries(this.rows)) {
      const value = core.get(name);
      if (row.list) row.list.selectedIndex = value;
      if (row.field) row.field.value = row.field === document.activeElement
        ? decimal(value) : brief(value);
      if (row.slider) row.slider.value = row.span.from(value);
      const differs = !Object.is(value, this.own[name]);
      row.title.className = differs ? 'was' : '';
      count += differs;
    }
    this.rows.rest.label.hidden = core.unused('rest') !== null;
    $('changed').textContent =
      count ? `${count} changed` : 'as in the scene';
  }
}

// Two sliders that push while they are not at their middle. What they show is
// the motion's.
export class Hand {
  // push(force, torque): from the present on.
  constructor(motion, push) {
    this.motion = motion;
    for (const [name, unit, most, words] of [
      ['force', 'N', 5, 'by hand on the slider, along its rail'],
      ['torque', 'N m', 2, 'by hand on the disc, about its axis']]) {
      const title = `${name}: ${words} [${unit}]`;
      const slider = element('input', { type: 'range', min: -most, max: most,
        step: most / 100, title, ariaLabel: title });
      const told = element('output');
      const set = (value) => {
        const { force, torque } = { ...motion.held, [name]: value };
        push(force, torque);
      };
      slider.oninput = () => set(Number(slider.value));
      slider.ondblclick = () => set(0);
      this[name] = { slider, told };
      $('hand').append(element('span', { title }, name), slider, told,
        element('span', { className: 'unit' }, unit));
    }
  }

  show() {
    for (const name of ['force', 'torque']) {
      this[name].slider.value = this.motion.held[name];
      this[name].told.textContent = this.motion.held[name].toFixed(2);
    }
  }
}
