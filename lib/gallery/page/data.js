'use strict';
// The element #page has the datasets and classes, #dataset-0 and so on what the page knows of each
// dataset: see gallery.cpp and dataset_page.cpp. A dataset is read when it is chosen. `state` has
// what the page shows at the moment.

const $ = id => document.getElementById(id);
const page = JSON.parse($('page').textContent);
const colours = ['#ffc454', '#78cdeb', '#f278a0', '#a0e26e', '#c4a0fa', '#fa965a', '#e8e080', '#70e0c0'];

// `hidden` has the classes that are switched off; `selected` is a label, or -1.
const state = {dataset: 0, sensor: 0, ping: 0, view: 0, playing: 0, hidden: new Set(), selected: -1};
let data;   // the dataset
let track;  // its poses

// Poses are stored as differences of whole numbers: mm, ms and hundredths of a degree.
function summed(differences, unit) {
  let sum = 0;
  return differences.map(d => (sum += d) * unit);
}

function read_dataset(k) {
  data = JSON.parse($(`dataset-${k}`).textContent);
  track = {};
  for (const [name, unit] of [['t', 1e-3], ['x', 1e-3], ['y', 1e-3], ['z', 1e-3],
                              ['roll', 1e-2], ['pitch', 1e-2], ['yaw', 1e-2]])
    track[name] = summed(data.track[name], unit);
}

const sensor = () => data.sensors[state.sensor];
const view = () => sensor().views[state.view];
const pose = () => state.ping * sensor().every;

// A label is the number of an object, or of a class in a box that names no object.
const class_of = label => data.labels[label].class;
const colour_of = label => colours[class_of(label) % colours.length];
function label_text(label) {
  const name = data.labels[label].name;
  const of_class = page.classes[class_of(label)];
  return name === of_class ? name : `${name} (${of_class})`;
}

// A path from the folder of the page.
function path_of(file) {
  const folder = page.datasets[state.dataset].folder;
  return folder ? `${folder}/${file}` : file;
}
