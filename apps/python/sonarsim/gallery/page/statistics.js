// Counts of the objects in the pictures of the sensor, by class, of this dataset or of all.

let of_all = page.datasets.length > 1;
const class_colour = name => colours[Math.max(0, page.classes.indexOf(name)) % colours.length];

function table_of(heads, rows) {
  const table = element('table', '');
  for (const [k, cells] of [heads, ...rows].entries()) {
    const made = cells.map(() => element(k ? 'td' : 'th', ''));
    cells.forEach((cell, column) => made[column].append(...[cell].flat()));
    table.insertRow().append(...made);
  }
  return table;
}

// A row for each interval with a bar of the counts of each class.
function histogram_of(classes, [title, edges], axis) {
  const sums = [...edges, 0].map((_, k) => classes.reduce((sum, one) => sum + one[4][axis][k], 0));
  const most = Math.max(...sums);
  if (!most) return [];
  return [table_of([title, '', 'labels'], sums.map((sum, k) => {
    const bar = element('span', '', 'bar');
    for (const [name, , , , bars] of classes) {
      bar.append(Object.assign(swatch(class_colour(name), 'part'), {title: `${name}: ${bars[axis][k]}`}));
      bar.lastChild.style.width = `${100 * bars[axis][k] / most}%`;
    }
    return [k ? `${edges[k - 1]} to ${edges[k] ?? '...'}` : `below ${edges[0]}`, bar, `${sum}`];
  }))];
}

function show_statistics() {
  const tally = of_all ? page.statistics[sensor().name] : sensor().statistics;
  const scopes = page.datasets.length > 1 ? ['all datasets', page.datasets[state.dataset][0]] : [];
  buttons($('scopes'), scopes, of_all ? 0 : 1, k => { of_all = k === 0; show_statistics(); });
  $('tallies').replaceChildren();
  if (!tally || !tally.pictures) $('tallies').append('No objects: render with output.labels: [objects].');
  else $('tallies').append(
    element('p', `${sensor().name}: ${tally.pictures} pictures, ${tally.empty} without an object`),
    table_of(['class', 'objects', 'pictures', 'labels'], tally.classes.map(one =>
      [[swatch(class_colour(one[0])), one[0]], `${one[1]}`, `${one[2]}`, `${one[3]}`])),
    ...page.axes.flatMap((axis, k) => histogram_of(tally.classes, axis, k)));
}
