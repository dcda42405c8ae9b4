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

const titles = {range_m: 'range, m', area: 'size, pixels or bins', contrast_db: 'contrast, dB',
                visible_share: 'visible share'};

// A row for each interval with a bar of the counts of each class, from the first that is not empty to the last.
function histogram_of(classes, fact) {
  const edges = page.edges[fact];
  const sums = [...edges, 0].map((_, k) => classes.reduce((sum, one) => sum + one[fact][k], 0));
  const [first, most] = [sums.findIndex(sum => sum), Math.max(...sums)];
  if (!most) return [];
  const rows = sums.map((sum, k) => {
    const bar = element('span', '', 'bar');
    for (const one of classes) {
      bar.append(Object.assign(swatch(class_colour(one.name), 'part'), {title: `${one.name}: ${one[fact][k]}`}));
      bar.lastChild.style.width = `${100 * one[fact][k] / most}%`;
    }
    return [k ? `${edges[k - 1]} to ${edges[k] ?? '...'}` : `below ${edges[0]}`, bar, `${sum}`];
  });
  return [table_of([titles[fact], '', 'labels'], rows.slice(first, sums.findLastIndex(sum => sum) + 1))];
}

function show_statistics() {
  const tally = of_all ? page.statistics[sensor().name] : sensor().statistics;
  const scopes = page.datasets.length > 1 ? ['all datasets', page.datasets[state.dataset][0]] : [];
  buttons($('scopes'), scopes, of_all ? 0 : 1, k => { of_all = k === 0; show_statistics(); });
  $('tallies').replaceChildren();
  if (!tally || !tally.pictures) $('tallies').append('No objects: render with output.labels: [objects].');
  else {
    const classes = tally.classes.filter(one => one.annotations);
    $('tallies').append(
      element('p', `${sensor().name}: ${tally.pictures} pictures, ${tally.without_objects} without an object`),
      table_of(['class', 'objects', 'pictures', 'labels'], classes.map(one =>
        [[swatch(class_colour(one.name)), one.name], `${one.objects}`, `${one.pictures}`, `${one.annotations}`])),
      ...Object.keys(titles).flatMap(fact => histogram_of(classes, fact)));
  }
}
