/* Maps of errors over the picture, up to a line that moves. shown: what page.js looks at. */
var pageMaps = function (study, extras, shown) {
    'use strict';

    const { byId, make, fill, fillSelect } = pageElements, data = studyData;
    const slider = byId('slider'), stage = byId('stage');

    function hasMap(config) {
        return Boolean(extras.images[config.map]);
    }

    function show(config) {
        const size = shown.frame.size || [1, 1], v = config.values, isRinged = data.hasWorst(config);
        byId('map-of').value = config.index;
        byId('map').src = extras.images[config.map];
        byId('map').alt = 'Errors of ' + config.title;
        byId('worst').hidden = !isRinged;
        byId('worst').style.left = 100 * (v.worst_x + 0.5) / size[0] + '%';
        byId('worst').style.top = 100 * (v.worst_y + 0.5) / size[1] + '%';
        byId('map-says').textContent = 'RMS ' + data.error(v.error_rms) + ', largest ' +
            data.error(v.error_max) + (isRinged ? ', which is in the ring' : '') + '; mostly of ' +
            config.mainCause + '.';
    }

    /* Those of the frame; at first the one with the largest error. */
    function fillIn() {
        const some = shown.configs.filter(hasMap), picture = extras.images[shown.frame.picture];
        byId('maps').hidden = byId('to-maps').hidden = some.length === 0 || !picture;
        if (byId('maps').hidden)
            return;
        byId('picture').src = picture;
        byId('picture').alt = 'The reference picture of ' + shown.frame.name;
        fillSelect(byId('map-of'), some.map(c => ({ value: c.index, text: c.title })), some[0].index);
        show(some.reduce((a, b) => b.values.error_rms > a.values.error_rms ? b : a));
    }

    /* percent: of the width that shows the picture. */
    function move(percent) {
        slider.value = percent;
        stage.style.setProperty('--split', slider.value);
        slider.setAttribute('aria-valuetext', slider.value + ' % picture, the rest errors');
    }

    function drag(event) {
        const box = stage.getBoundingClientRect();
        if (event.type === 'pointerdown')
            stage.setPointerCapture(event.pointerId);
        if (event.buttons & 1)
            move(Math.round(100 * (event.clientX - box.left) / box.width));
    }

    /* Colours of the ends and between, and a few of the errors that they stand for. */
    function showKey() {
        const ends = data.list(study.map_errors), colors = data.list(extras.ramp), count = 5;
        const error = i => ends[0] * Math.pow(ends[1] / ends[0], i / (count - 1));
        byId('ramp').style.background = 'linear-gradient(to right, ' + colors.join(', ') + ')';
        if (ends.length === 2)
            fill(byId('ramp-texts'), ...Array.from({ length: count }, (_, i) =>
                make('span', {}, i === count - 1 && ends[1] === 1 ? '1' : error(i).toExponential(0))));
    }

    byId('map-of').addEventListener('change', event => show(shown.configs[+event.target.value]));
    slider.addEventListener('input', () => move(slider.value));
    ['pointerdown', 'pointermove'].forEach(type => stage.addEventListener(type, drag));
    move(50);
    showKey();
    return { fillIn, show, hasMap };
};
