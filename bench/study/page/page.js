/* The page: what is looked at of a study. Data come from study_data.js, plots from study_plots.js; each
 * section has a file of its own. */
(function () {
    'use strict';

    const { byId, make, fill, sentence, fillSelect } = pageElements, data = studyData;
    const study = JSON.parse(byId('study').textContent), extras = JSON.parse(byId('extras').textContent);
    const frames = data.list(study.frames);
    /* The frame, its configurations, those on the front, the axes, and the index of the one selected. */
    const shown = { frame: {}, configs: [], front: [], selected: 0,
                    errorKey: 'error_rms', timeKey: 'light_ratio' };
    const tables = pageTables(study, shown, choose), front = pageFront(shown, select);
    const maps = pageMaps(study, extras, shown);

    function showDetails() {
        const config = shown.configs[shown.selected], number = shown.front.indexOf(config) + 1;
        fill(byId('details'), ...(config ? pageDetails(study, config, number, shown.timeKey)
                                         : ['No configuration was measured.']));
    }

    function select(index) {
        shown.selected = index;
        front.mark();
        showDetails();
        document.querySelectorAll('tr[data-index]').forEach(row =>
            row.classList.toggle('selected', +row.dataset.index === index));
        if (maps.hasMap(shown.configs[index]))
            maps.show(shown.configs[index]);
    }

    /* From a table: what is selected is brought into sight. */
    function choose(index) {
        select(index);
        byId('front-plot').scrollIntoView({ block: 'nearest' });
        byId('details').focus();
    }

    function drawCauses() {
        const spec = data.causesSpec(study, byId('rows').value === 'front' ? shown.front : shown.configs);
        spec.width = Math.max(300, Math.floor(byId('causes-room').clientWidth));
        studyPlots.causes(d3, byId('causes-plot'), spec);
    }

    function save(id) {
        const text = studyPlots.fileOf(byId(id), byId('plot-style').textContent);
        const url = URL.createObjectURL(new Blob([text], { type: 'image/svg+xml' }));
        const name = (shown.frame.name || 'study') + '-' + id.replace('-plot', '') + '.svg';
        make('a', { href: url, download: name }).click();
        setTimeout(() => URL.revokeObjectURL(url), 10000);
    }

    /* --- what was measured, and how --- */

    function sayIntervals() {
        const of = study.intervals;
        if (of && data.isNumber(of.coverage))
            byId('interval-says').textContent = 'Horizontal bars are intervals of the time: another run’s ' +
                'median lies inside in ' + (100 * of.coverage).toFixed(1) + ' of 100.';
    }

    function when() {
        return String(study.when || extras.written || '').replace('T', ' ').replace(/:\d\dZ$/, ' UTC');
    }

    function machine() {
        const of = study.machine || {};
        return [of.processor, of.threads ? of.threads + ' threads' : ''].filter(t => t).join(', ');
    }

    function subject() {
        const f = shown.frame, size = data.list(f.size).join(' × ');
        return [f.name, size && size + ' px', data.isNumber(f.lights) && f.lights + ' lights',
                shown.configs.length + ' configurations', machine(), when()].filter(t => t).join(' · ');
    }

    function facts() {
        const f = shown.frame, device = study.device || {}, load = (study.machine || {}).load_before;
        const rows = [
            ['Scene', [f.name, f.source].filter(t => t).join(': ')],
            ['Planes', data.list(f.planes).join(', ')],
            ['Reference', f.reference],
            ['Mean radiance', data.isNumber(f.mean_radiance) ? data.amount(f.mean_radiance) : ''],
            ['Exposure', data.isNumber(f.exposure) ? data.amount(f.exposure) + ' stops' : ''],
            ['Device', [device.name, device.platform, device.driver].filter(t => t).join(', ')],
            ['Lanes of a vector', device.lanes ? String(device.lanes) : ''],
            ['Machine', machine()],
            ['Load before', data.isNumber(load) ? load.toFixed(2) : ''],
            ['When', when()],
        ];
        return [].concat(...rows.filter(r => r[1]).map(r => [make('dt', {}, r[0]), make('dd', {}, r[1])]));
    }

    function meanings() {
        const groups = [['Causes', study.causes], ['Knobs', study.knobs], ['Times', study.times],
                        ['Values', study.values]];
        const text = r => r.meaning + (r.unit ? ' (' + r.unit + ')' : '');
        const entry = r => [make('dt', {}, r.name), make('dd', {}, text(r))];
        const group = g => [make('h3', {}, g[0])].concat(...data.list(g[1]).map(entry));
        return [].concat(...groups.map(group));
    }

    function copyCommand() {
        const range = document.createRange();
        range.selectNodeContents(byId('command'));
        getSelection().removeAllRanges();
        getSelection().addRange(range);
        byId('copy').textContent = document.execCommand('copy') ? 'Copied' : 'Selected';
    }

    /* --- the whole --- */

    function showAxes() {
        shown.front = data.front(shown.configs, shown.errorKey, shown.timeKey);
        front.draw();
        tables.front();
        showDetails();
        drawCauses();
    }

    function showFrame(index) {
        shown.frame = frames[index] || {};
        shown.configs = data.configurations(study, shown.frame);
        shown.selected = Math.max(0, shown.configs.findIndex(c => c.isUsual));
        document.title = 'What accuracy costs in time: ' + (shown.frame.name || 'nothing');
        byId('subject').textContent = subject();
        fill(byId('findings-list'), ...data.findings(study, shown.configs).map(t => sentence('li', t)));
        fill(byId('machine'), ...facts());
        showAxes();
        maps.fillIn();
        tables.all();
    }

    function listen() {
        let width = window.innerWidth;
        byId('frame').addEventListener('change', event => showFrame(+event.target.value));
        ['error', 'time'].forEach(axis => byId(axis).addEventListener('change', event => {
            shown[axis + 'Key'] = event.target.value;
            showAxes();
        }));
        byId('rows').addEventListener('change', drawCauses);
        byId('copy').addEventListener('click', copyCommand);
        document.querySelectorAll('.save').forEach(one =>
            one.addEventListener('click', () => save(one.dataset.plot)));
        window.addEventListener('resize', () => {
            if (window.innerWidth === width)
                return;
            width = window.innerWidth;
            front.draw();
            drawCauses();
        });
    }

    byId('choice').hidden = frames.length < 2;
    fillSelect(byId('frame'), frames.map((f, i) => ({ value: i, text: f.name })), 0);
    fillSelect(byId('error'), data.errors.map(e => ({ value: e.key, text: e.name })), shown.errorKey);
    fillSelect(byId('time'), data.times.map(t => ({ value: t.key, text: t.name })), shown.timeKey);
    byId('command').textContent = study.command || '';
    byId('command-part').hidden = !study.command;
    byId('licence').textContent = extras.licence;
    fill(byId('meanings'), ...meanings());
    sayIntervals();
    tables.claims();
    listen();
    showFrame(0);
})();
