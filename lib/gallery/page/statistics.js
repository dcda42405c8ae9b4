// The statistics of labels: of the dataset or of all, of each COCO file or of all pictures.

const chosen = {whole: true, file: ''};

const class_colour = name => colours[Math.max(0, page.classes.indexOf(name)) % colours.length];
const interval = (edges, k) => k === 0 ? `below ${edges[0]}` :
  k === edges.length ? `from ${edges[k - 1]}` : `${edges[k - 1]} to ${edges[k]}`;

function table_of(heads, rows) {
  const table = document.createElement('table');
  const write = (cells, kind) => {
    const row = table.insertRow();
    for (const cell of cells) {
      const made = element(kind, '');
      made.append(...[cell].flat());
      row.append(made);
    }
  };
  write(heads, 'th');
  for (const cells of rows) write(cells, 'td');
  return table;
}

// A bar of the counts of each class in an interval.
function bar_of(classes, axis, k, most) {
  const bar = element('span', '', 'bar');
  for (const one of classes) {
    const part = swatch(class_colour(one.name));
    part.className = 'part';
    part.style.width = `${100 * one[axis.key][k] / most}%`;
    part.title = `${one.name}: ${one[axis.key][k]}`;
    bar.append(part);
  }
  return bar;
}

function histogram_of(classes, axis) {
  const sums = axis.edges.concat(0).map((_, k) => classes.reduce((sum, one) => sum + one[axis.key][k], 0));
  const [first, last] = [sums.findIndex(sum => sum), sums.findLastIndex(sum => sum)];
  if (first < 0) return [];
  const most = Math.max(...sums);
  const rows = [];
  for (let k = first; k <= last; ++k)
    rows.push([interval(axis.edges, k), [bar_of(classes, axis, k, most)], `${sums[k]}`]);
  return [table_of([axis.title, '', 'labels'], rows)];
}

function show_statistics() {
  const counts = chosen.whole ? page.statistics : data.statistics;
  const scopes = [['all datasets', true], [page.datasets[state.dataset].folder || 'the dataset', false]];
  const offered = page.datasets.length > 1 ? scopes : scopes.slice(1);
  buttons($('scopes'), offered.map(one => one[0]), offered.findIndex(one => one[1] === chosen.whole), k => {
    chosen.whole = offered[k][1];
    show_statistics();
  });
  $('tallies').textContent = '';
  $('files').textContent = '';
  if (!counts) {
    $('tallies').append(element('p', 'None: they are made with the label coco, once all pings are there.'));
    return;
  }
  const files = ['', ...Object.keys(counts.files)];
  if (!files.includes(chosen.file)) chosen.file = '';
  buttons($('files'), files.map(file => file ? file.split('/').pop() : 'all pictures'), files.indexOf(chosen.file), k => {
    chosen.file = files[k];
    show_statistics();
  });
  const tally = chosen.file ? counts.files[chosen.file] : counts.all;
  for (const warning of chosen.file ? [] : counts.warnings) $('tallies').append(element('p', warning, 'warning'));
  $('tallies').append(element('p', `${tally.pictures} pictures, ${tally.without_objects} without an object`));
  $('tallies').append(table_of(['class', 'objects', 'pictures', 'labels', 'ignored'], tally.classes.map(one =>
    [[swatch(class_colour(one.name)), one.name], ...['objects', 'pictures', 'annotations', 'ignored'].map(key => `${one[key]}`)])));
  for (const axis of page.axes) $('tallies').append(...histogram_of(tally.classes, axis));
}

function toggle_statistics() {
  const are_shown = $('statistics').hidden;
  $('statistics').hidden = !are_shown;
  $('pings').hidden = $('sensors').hidden = are_shown;
  $('switch').className = are_shown ? 'on' : '';
  if (are_shown) show_statistics();
  else show();
}
