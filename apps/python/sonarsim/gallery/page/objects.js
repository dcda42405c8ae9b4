// The legend of the classes, the list of objects, and the way through the pings that show one.

const most_rows = 300;  // of the list: more would make the page slow
const sightings = count => count ? `${count} ${count === 1 ? 'sighting' : 'sightings'}` : 'not seen';

function show_legend() {
  $('legend').replaceChildren(...page.classes.map((name, k) => {
    const box = Object.assign(element('input', ''), {type: 'checkbox', checked: !state.hidden.has(k)});
    box.onchange = () => {
      state.hidden[box.checked ? 'delete' : 'add'](k);
      box.blur();
      show_objects();
      show();
    };
    const row = element('label', '');
    row.append(box, swatch(colours[k % colours.length]), `${name} `);
    return row;
  }));
}

// A row for each object, those that most pings show first.
function show_objects() {
  const counts = data.labels.map((_, label) => pings_of(label).length);
  const rows = [...counts.keys()].filter(label => !state.hidden.has(class_of(label)));
  rows.sort((a, b) => counts[b] - counts[a] || a - b);
  $('objects').replaceChildren(...rows.slice(0, most_rows).map(label => {
    const row = element('button', '', label === state.selected ? 'on' : '');
    row.append(swatch(colour_of(label)), `${label_text(label)} `, element('small', sightings(counts[label])));
    row.onclick = () => { row.blur(); select(label === state.selected ? -1 : label); };
    return row;
  }));
  if (rows.length > most_rows) $('objects').append(element('small', `and ${rows.length - most_rows} more`));
}

// Selects an object, or nothing with -1, and goes to the nearest ping that shows it, of another sensor if need be.
function select(label) {
  state.selected = label;
  const shows = one => one.seen[label];
  if (!shows(sensor()) && data.sensors.some(shows)) choose_sensor(data.sensors.findIndex(shows));
  if (shows(sensor()) && view() && !view().width) choose_view(sensor().views.findIndex(one => one.width));
  const is_here = !(view() && 'pings_along' in view()) && entries_of(view(), state.ping).some(entry => entry[0] === label);
  if (shows(sensor()) && !is_here)
    state.ping = pings_of(label).reduce((a, b) => Math.abs(b - state.ping) < Math.abs(a - state.ping) ? b : a);
  show_objects();
  show();
}

// Goes to the next ping that shows the selected object, or back; after the last the first follows.
function step_object(by) {
  const seen = pings_of(state.selected);
  const next = by > 0 ? seen.find(ping => ping > state.ping) : seen.findLast(ping => ping < state.ping);
  if (seen.length) go(next === undefined ? seen.at(by > 0 ? 0 : -1) : next);
}

function show_chosen() {
  $('chosen').hidden = state.selected < 0;
  if (state.selected < 0) return;
  const [seen, pings] = [pings_of(state.selected), view() && view().per === 'sweep' ? view().pings : 1];
  const at = seen.findIndex(ping => Math.floor(ping / pings) === Math.floor(state.ping / pings));
  $('which').textContent = `${label_text(state.selected)}: ${at < 0 ? sightings(seen.length) :
    `sighting ${at + 1} of ${seen.length}`}`;
}

function table_of(heads, rows) {
  const table = element('table', '');
  for (const [k, cells] of [heads, ...rows].entries()) {
    const made = cells.map(() => element(k ? 'td' : 'th', ''));
    cells.forEach((cell, column) => made[column].append(...[cell].flat()));
    table.insertRow().append(...made);
  }
  return table;
}

// Writes the facts of the selected object at this ping, of the ping and of the variant.
function show_facts() {
  const own = entries_of(view(), state.ping).filter(entry => entry[0] === state.selected);
  const rows = [...own.map(entry => entry[1]), {ping: pose()}, known_of(state.ping).meta || {},
                page.datasets[state.dataset][1]].flatMap(Object.entries).map(texts => texts.map(String));
  if (sensor().meta) {
    const link = element('a', 'all of its metadata');
    link.href = url_of(sensor().meta, pose());
    rows.push([[link]]);
  }
  $('facts').replaceChildren(...table_of([], rows).rows);
}
