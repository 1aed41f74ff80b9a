// What the page says in words: the state, and the command line that computes
// the same.
import { AT } from './core.mjs';
import { differences } from './address.mjs';
import { decimal } from './decimal.mjs';
import { $, element } from './draw.mjs';

const cell = (name, value, more = {}) => element('div', {},
  element('dt', {}, name), element('dd', more, value.replace('-', '\u2212')));

export function showState(row, modes) {
  const mode = row[AT.mode], choices = row[AT.choices];
  $('time').textContent = `t = ${row[AT.t].toFixed(4)} s`;
  $('state').replaceChildren(
    cell('r', `${row[AT.r].toFixed(5)} m`),
    cell('v', `${row[AT.v].toFixed(4)} m/s`),
    cell('ω', `${row[AT.omega].toFixed(4)} rad/s`),
    cell('', modes[mode], { className: `mode mode${mode}` }),
    cell('F', `${row[AT.F].toFixed(3)} N`),
    cell('M', `${row[AT.M].toFixed(3)} N m`),
    cell('E', Number.isNaN(row[AT.energy]) ? '–'
      : `${row[AT.energy].toFixed(4)} J`),
    cell(`${choices} future${choices === 1 ? '' : 's'}`, ''));
}

// The strips, for those who do not see them.
export function tellTime(strips, row, end, modes) {
  strips.setAttribute('aria-valuemax', end.toFixed(4));
  strips.setAttribute('aria-valuenow', row[AT.t].toFixed(4));
  strips.setAttribute('aria-valuetext', `t = ${row[AT.t].toFixed(4)} s, ` +
    `${modes[row[AT.mode]]}, ${row[AT.choices]} possible`);
}

// A time of which the nearest step is that one, short where it can be.
function seconds(steps, dt) {
  const brief = Number((steps * dt).toPrecision(12));
  return Math.round(brief / dt) === steps ? brief : steps * dt;
}

export function commandLine(core, scene, motion, steps) {
  const words = [], names = [];
  for (const [name, value] of differences(core, scene)) {
    names.push(name);
    if (name !== 'seed' && name !== 'rule')
      words.push(`--set ${name}=${value}`);
  }
  const rule = core.lists.rule[core.get('rule')];
  if (names.includes('rule') || names.includes('seed') && rule === 'random')
    words.push(`--select ${rule}` +
      (rule === 'random' ? `:${core.get('seed')}` : ''));
  const file = scene === core.ownScene ? core.file.name : null;
  const name = file === null ? core.scenes[scene]
    : file.includes('.') ? file : `./${file}`;
  return ['twofold run', name, ...words, '--t-end',
    decimal(seconds(steps, motion.dt)), '--every', motion.every].join(' ') +
    (motion.log.length ? '  # but for what was done by hand' : '');
}
