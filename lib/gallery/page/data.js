'use strict';
// What the page knows stands in the element #dataset, made by gallery.cpp, and what it shows at the
// moment in `state`.

const $ = id => document.getElementById(id);
const data = JSON.parse($('dataset').textContent);
const colours = ['#ffc454', '#78cdeb', '#f278a0', '#a0e26e', '#c4a0fa', '#fa965a', '#e8e080', '#70e0c0'];

// Poses are stored as differences of whole numbers: mm, ms and hundredths of a degree.
function summed(differences, unit) {
  let sum = 0;
  return differences.map(d => (sum += d) * unit);
}
const track = {};
for (const [name, unit] of [['t', 1e-3], ['x', 1e-3], ['y', 1e-3], ['z', 1e-3],
                            ['roll', 1e-2], ['pitch', 1e-2], ['yaw', 1e-2]])
  track[name] = summed(data.track[name], unit);

const state = {sensor: 0, ping: 0, view: 0, playing: 0};
const sensor = () => data.sensors[state.sensor];
const view = () => sensor().views[state.view];
const pose = () => state.ping * sensor().every;
