/* Writes plots of a study as SVG files, drawn by the page's own code: see scripts/study-svg. */
'use strict';

const fs = require('fs'), path = require('path');
const { JSDOM } = require('jsdom');
const d3 = require(process.env.D3);
const data = require('./study_data.js'), plots = require('./study_plots.js');

const WIDTH = 860; /* px, of a column of text on most pages */

const [folder, out, name] = process.argv.slice(2);
const study = JSON.parse(fs.readFileSync(path.join(folder, 'study.json'), 'utf8'));
const frames = data.list(study.frames);
const frame = name ? frames.find(f => f.name === name) : frames[0];
if (!frame) {
    const has = name ? 'no frame ' + name + ', only ' + frames.map(f => f.name).join(', ') : 'no frames';
    console.error('study-svg: ' + folder + '/study.json has ' + has);
    process.exit(1);
}

const style = fs.readFileSync(path.join(__dirname, 'plot.css'), 'utf8');
const page = new JSDOM('<!DOCTYPE html><svg id="plot"></svg>');
const node = page.window.document.getElementById('plot');

function write(file) {
    fs.writeFileSync(path.join(out, file), plots.fileOf(node, style));
    console.log(path.join(out, file));
}

const shown = { errorKey: 'error_rms', timeKey: 'light_ratio', configs: data.configurations(study, frame) };
shown.front = data.front(shown.configs, shown.errorKey, shown.timeKey);
plots.front(d3, node, Object.assign({ width: WIDTH }, data.frontSpec(shown)));
write('front.svg');
plots.causes(d3, node, Object.assign({ width: WIDTH }, data.causesSpec(study, shown.front)));
write('causes.svg');
