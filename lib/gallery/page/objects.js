// The legend of the classes, the list of objects, and the way through the pings that show one.

const most_rows = 300;  // of the list: more would make the page slow

function element(kind, text, name) {
  const made = document.createElement(kind);
  made.textContent = text;
  if (name) made.className = name;
  return made;
}

function swatch(colour) {
  const made = element('span', '', 'swatch');
  made.style.background = colour;
  return made;
}

// A box switches a class on and off in the picture, the plan and the list.
function show_legend() {
  $('legend').textContent = '';
  page.classes.forEach((name, k) => {
    const objects = data.labels.slice(0, data.objects).filter(label => label.class === k).length;
    const box = document.createElement('input');
    box.type = 'checkbox';
    box.checked = !state.hidden.has(k);
    box.onchange = () => {
      box.checked ? state.hidden.delete(k) : state.hidden.add(k);
      box.blur();
      draw_picture();
      draw_plan();
      show_objects();
    };
    const row = element('label', '');
    row.append(box, swatch(colours[k % colours.length]), `${name} `, element('small', `${objects}`));
    $('legend').append(row);
  });
}

// A row for each object, those that most pings show first. A click selects it.
function show_objects() {
  const list = $('objects');
  list.textContent = '';
  const {pings} = sightings(state.sensor);
  const rows = [];
  for (let label = 0; label < data.objects; ++label)
    if (!state.hidden.has(class_of(label))) rows.push([label, (pings.get(label) || []).length]);
  rows.sort((a, b) => b[1] - a[1] || a[0] - b[0]);
  for (const [label, count] of rows.slice(0, most_rows)) {
    const row = element('button', '', label === state.selected ? 'on' : '');
    row.append(swatch(colour_of(label)), `${label_text(label)} `,
               element('small', count ? `${count} ${count === 1 ? 'ping' : 'pings'}` : 'not seen'));
    row.onclick = () => { select(label === state.selected ? -1 : label); row.blur(); };
    list.append(row);
  }
  if (rows.length > most_rows) list.append(element('small', `and ${rows.length - most_rows} more`));
}

// Selects a label, or nothing with -1, and goes to the nearest ping that shows it. If the chosen
// sensor never shows it, the page changes to one that does.
function select(label) {
  state.selected = label;
  const shows = k => sightings(k).pings.has(label);
  if (label >= 0 && !shows(state.sensor)) {
    const other = data.sensors.findIndex((_, k) => shows(k));
    if (other >= 0) choose_sensor(other);
  }
  const {view: best, pings} = sightings(state.sensor);
  const seen = pings.get(label) || [];
  if (seen.length && best !== state.view) choose_view(best);
  const away = ping => Math.abs(ping - state.ping);
  if (seen.length && !boxes_of(view(), state.ping).some(box => box[0] === label))
    state.ping = seen.reduce((a, b) => away(b) < away(a) ? b : a);
  show_objects();
  show();
}

// To the next ping that shows the selected object, or back; after the last the first follows.
function step_object(by) {
  const seen = sightings(state.sensor).pings.get(state.selected) || [];
  if (!seen.length) return;
  const next = by > 0 ? seen.find(ping => ping > state.ping) : seen.findLast(ping => ping < state.ping);
  go(next === undefined ? seen.at(by > 0 ? 0 : -1) : next);
}

function show_chosen() {
  const is_one = state.selected >= 0;
  $('chosen').hidden = !is_one;
  if (!is_one) return;
  const seen = sightings(state.sensor).pings.get(state.selected) || [];
  const at = seen.indexOf(state.ping);
  const count = `${seen.length} ${seen.length === 1 ? 'ping' : 'pings'}`;
  const where = at < 0 ? `seen in ${count} of ${sensor().name}` : `ping ${at + 1} of ${seen.length} that show it`;
  $('which').textContent = `${label_text(state.selected)}: ${where}`;
}
