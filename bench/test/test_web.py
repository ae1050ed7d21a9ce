# SPDX-License-Identifier: GPL-3.0-only
"""bench.html as a browser shows it and as its reader uses it."""

import json
import math
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from selenium import webdriver
from selenium.webdriver import ActionChains, Chrome, Keys
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.by import By
from selenium.webdriver.remote.webelement import WebElement
from selenium.webdriver.support.select import Select

import figures
from report import content
from stored import SIZE, Stored
from tables import NOTHING, Cell, Table, number
from web import write_html

FLAGS = ['--headless', '--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run',
         '--disable-background-networking', '--disable-component-update', '--disable-sync']
ODD_SCENE = '<i>s<\\i> & "100 %" #1_~^{} \u043a\u0434'
ODD_KERNEL = "k<script>alert('k')&amp;<br>_%#:size=<b>"
SORTED = Table('Sorted', ['name', 'rate'], [
    [Cell('k10'), number(9.5, '9.5')],
    [Cell('k9'), Cell('', error='crashed')],
    [Cell('a'), number(100, '100', error='3 ppm wrong')],
    [Cell(''), NOTHING],
    [Cell('b'), number(math.inf, 'never')],
    [Cell('C'), number(-2, '-2')]])


def page(stored: Stored, file: Path, more: list[Table] | None = None) -> Path:
    """Writes bench.html of the results, with more tables in its summary."""
    pictures = stored.folder.with_name(f'{stored.folder.name}-pictures')
    pictures.mkdir(exist_ok=True)
    measured = stored.measured()
    shown = content(measured, pictures)
    shown['summary'] += more or []
    names = figures.draw_all(measured, pictures)
    file.write_bytes(write_html(shown, names, pictures))
    return file


def store_odd_names(folder: Path) -> Stored:
    stored = Stored(folder)
    stored.run(ODD_SCENE, ODD_KERNEL)
    stored.run(ODD_SCENE, 'other', status='crashed', message='<b>SIGSEGV</b> & "more"')
    return stored


@pytest.fixture(scope='module')
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp('web')


@pytest.fixture(scope='module')
def kernels_page(folder: Path) -> Path:
    """Three kernels, of which two have the same image, and a table to sort."""
    stored = Stored(folder / 'kernels')
    stored.benchmark(['box'], ['simple-bvh', 'funky-kd', 'wrong'], repeats=1,
                     answers={'wrong': {'missed': 3}})
    return page(stored, folder / 'kernels.html', [SORTED])


@pytest.fixture(scope='module')
def odd_page(folder: Path) -> Path:
    return page(store_odd_names(folder / 'odd'), folder / 'odd.html')


@pytest.fixture(scope='module')
def failed_page(folder: Path) -> Path:
    stored = Stored(folder / 'failed')
    for scene in ['box', 'hall']:
        stored.run(scene, 'simple-bvh', status='timed out', message='after 1 s')
    return page(stored, folder / 'failed.html')


@pytest.fixture(scope='module')
def chrome(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Chrome]:
    options = webdriver.ChromeOptions()
    options.binary_location = '/usr/bin/chromium'
    for flag in [*FLAGS, f"--user-data-dir={tmp_path_factory.mktemp('chromium')}"]:
        options.add_argument(flag)
    options.set_capability('goog:loggingPrefs', {'performance': 'ALL', 'browser': 'ALL'})
    driver = webdriver.Chrome(options=options, service=Service('/usr/bin/chromedriver'))
    yield driver
    driver.quit()


@pytest.fixture
def kernels(chrome: Chrome, kernels_page: Path) -> Chrome:
    """The browser with this page as it opens."""
    chrome.get(kernels_page.as_uri())
    return chrome


def one(place: Chrome | WebElement, selector: str) -> WebElement:
    return place.find_element(By.CSS_SELECTOR, selector)


def every(place: Chrome | WebElement, selector: str) -> list[WebElement]:
    return place.find_elements(By.CSS_SELECTOR, selector)


def texts(place: Chrome | WebElement, selector: str) -> list[str]:
    return [element.text for element in every(place, selector)]


# ---- The whole file -----------------------------------------------------------------------------


def test_two_processes_write_the_same_bytes(odd_page: Path, folder: Path) -> None:
    again = folder / 'again.html'
    write = ('import sys; from pathlib import Path; import test_web; '
             'test_web.page(test_web.Stored(Path(sys.argv[1])), Path(sys.argv[2]))')
    subprocess.run([sys.executable, '-W', 'ignore', '-c', write, str(folder / 'odd'), str(again)],
                   check=True, env=os.environ | {'PYTHONPATH': ':'.join(sys.path),
                                                 'PYTHONHASHSEED': '7'})
    assert again.read_bytes() == odd_page.read_bytes()


@pytest.mark.parametrize('name', ['kernels_page', 'odd_page', 'failed_page'])
def test_page_asks_for_nothing_but_itself(chrome: Chrome, name: str,
                                          request: pytest.FixtureRequest) -> None:
    file = request.getfixturevalue(name)
    chrome.get('about:blank')
    chrome.get_log('performance')
    chrome.get_log('browser')
    chrome.get(file.as_uri())
    messages = [json.loads(entry['message'])['message'] for entry in chrome.get_log('performance')]
    asked = {message['params']['request']['url'] for message in messages
             if message['method'] == 'Network.requestWillBeSent'}
    assert {url for url in asked if not url.startswith('data:')} == {file.as_uri()}
    assert chrome.get_log('browser') == []


def test_policy_forbids_to_load_from_elsewhere(kernels: Chrome) -> None:
    directive = kernels.execute_async_script('''
        const done = arguments[0];
        addEventListener('securitypolicyviolation', event => done(event.effectiveDirective));
        document.body.append(Object.assign(new Image(), {src: 'http://127.0.0.1:9/image.png'}));''')
    assert directive == 'img-src'


def test_all_images_are_shown_and_described(kernels: Chrome) -> None:
    images = kernels.execute_script('''
        return [...document.images].map(image => [image.naturalWidth > 0, image.alt])''')
    assert len(images) > 4
    assert all(is_loaded and alternative for is_loaded, alternative in images)


def test_names_are_shown_as_they_are(chrome: Chrome, odd_page: Path) -> None:
    chrome.get(odd_page.as_uri())
    assert ODD_SCENE in texts(chrome, 'nav a')
    assert ODD_SCENE in texts(chrome, 'h2')
    assert ODD_KERNEL in texts(chrome, '#summary tbody th')
    assert '<b>SIGSEGV</b> & "more"' in texts(chrome, '#summary td')
    assert ODD_KERNEL in one(chrome, '.shown').text
    assert every(chrome, 'i, b, br, body script:not(:last-child)') == []


def test_report_of_failures_only_opens_with_them(chrome: Chrome, failed_page: Path) -> None:
    chrome.get(failed_page.as_uri())
    table = one(chrome, 'main table')
    assert table.is_displayed()
    assert texts(table, 'tbody th') == ['box', 'hall']
    assert texts(table, 'td:last-child') == ['after 1 s'] * 2
    assert every(chrome, 'img, form') == []
    assert texts(chrome, 'section h2')[-2:] == ['All scenes', 'How this was measured']


# ---- Tables -------------------------------------------------------------------------------------


def names_in_order(chrome: Chrome) -> list[str]:
    return texts(chrome, '[aria-label=Sorted] tbody th')


def test_numbers_are_sorted_both_ways_and_gaps_stay_last(kernels: Chrome) -> None:
    heading = every(kernels, '[aria-label=Sorted] thead th')[1]
    one(heading, 'button').click()
    assert heading.get_attribute('aria-sort') == 'ascending'
    assert names_in_order(kernels) == ['C', 'k10', 'a', 'b', 'k9', '']
    one(heading, 'button').click()
    assert heading.get_attribute('aria-sort') == 'descending'
    assert names_in_order(kernels) == ['b', 'a', 'k10', 'C', 'k9', '']


def test_text_is_sorted_from_the_keyboard(kernels: Chrome) -> None:
    heading, other = every(kernels, '[aria-label=Sorted] thead th')
    one(other, 'button').click()
    one(heading, 'button').send_keys(Keys.ENTER)
    assert heading.get_attribute('aria-sort') == 'ascending'
    assert other.get_attribute('aria-sort') == 'none'
    assert names_in_order(kernels) == ['a', 'b', 'C', 'k9', 'k10', '']
    one(heading, 'button').send_keys(Keys.SPACE)
    assert names_in_order(kernels) == ['k10', 'k9', 'C', 'b', 'a', '']


def test_best_are_bold_and_errors_stand_out(kernels: Chrome) -> None:
    speed = every(kernels, '#summary table')[1]
    assert [int(element.value_of_css_property('font-weight')) >= 600
            for element in every(speed, 'tbody strong data')] == [True, True]
    error = one(speed, 'tbody .error')
    assert error.text == '3 ppm wrong'
    assert error.value_of_css_property('color') != speed.value_of_css_property('color')
    assert error.value_of_css_property('border-style') == 'solid'


# ---- Images -------------------------------------------------------------------------------------


def choose(chrome: Chrome, **values: str) -> None:
    """@param values of controls by name"""
    for name, value in values.items():
        if name == 'view':
            one(chrome, f'[name=view][value={value}]').click()
        else:
            Select(one(chrome, f'form [name={name}]')).select_by_visible_text(value)


def visible_image(chrome: Chrome) -> str:
    visible = [image for image in every(chrome, '.stage img') if image.is_displayed()]
    assert len(visible) == 1
    return str(visible[0].get_attribute('alt'))


def canvas_values(chrome: Chrome) -> list[list[int]]:
    """The red, green and blue values of each pixel of the difference image."""
    values: list[int] = chrome.execute_script('''
        const canvas = document.querySelector('.stage canvas');
        const context = canvas.getContext('2d');
        return [...context.getImageData(0, 0, canvas.width, canvas.height).data]''')
    return [values[i:i + 3] for i in range(0, len(values), 4)]


def test_images_that_are_the_same_are_embedded_once(kernels: Chrome) -> None:
    assert [image.get_attribute('alt') for image in every(kernels, '.stage img')] == [
        'box, rendered by simple-bvh, funky-kd', 'box, rendered by wrong']


def test_slider_moves_the_line_between_the_images(kernels: Chrome) -> None:
    said = one(kernels, '.shown').text
    assert said.startswith('Left of the line: simple-bvh; right of it: wrong.')
    line, second = one(kernels, '[name=line]'), every(kernels, '.stage img')[1]
    assert second.value_of_css_property('clip-path') == 'inset(0px 0px 0px 50%)'
    line.send_keys(Keys.END)
    assert second.value_of_css_property('clip-path') == 'inset(0px 0px 0px 100%)'
    stage = one(kernels, '.stage')
    left = stage.size['width'] // 4
    ActionChains(kernels).move_to_element(stage).click_and_hold().move_by_offset(-left, 0) \
        .release().perform()
    assert float(str(line.get_property('value'))) == pytest.approx(25, abs=1)
    mark = one(kernels, '.line').rect['x'] - stage.rect['x']
    assert mark == pytest.approx(stage.size['width'] / 4, abs=8)


def test_slider_hides_nothing_where_both_images_are_one(kernels: Chrome) -> None:
    choose(kernels, b='funky-kd')
    assert one(kernels, '.stage img').value_of_css_property('clip-path') == 'none'
    assert 'simple-bvh to the bit' in one(kernels, '.shown').text


def test_flip_swaps_the_images(kernels: Chrome) -> None:
    choose(kernels, view='flip')
    assert visible_image(kernels) == 'box, rendered by simple-bvh, funky-kd'
    one(kernels, '[name=flip]').click()
    assert visible_image(kernels) == 'box, rendered by wrong'
    one(kernels, '.window').send_keys(Keys.SPACE)
    assert visible_image(kernels) == 'box, rendered by simple-bvh, funky-kd'
    one(kernels, '.stage').click()
    assert visible_image(kernels) == 'box, rendered by wrong'
    assert one(kernels, '.shown').text.startswith('Shown: B, wrong.')


def test_difference_is_bright_where_images_differ_and_black_elsewhere(kernels: Chrome) -> None:
    choose(kernels, view='difference', factor='1')
    pixels = SIZE[0] * SIZE[1]
    first, *rest = canvas_values(kernels)
    assert min(first) > 0
    assert rest == [[0, 0, 0]] * (pixels - 1)
    said = one(kernels, '.shown').text
    assert f'times 1: 1 of {pixels} pixels differ.' in said
    assert f'1 of {pixels} pixels of the linear image of wrong differ from simple-bvh' in said
    choose(kernels, factor='2')
    assert canvas_values(kernels)[0] == [min(255, 2 * value) for value in first]
    choose(kernels, a='funky-kd', b='simple-bvh')
    assert canvas_values(kernels) == [[0, 0, 0]] * pixels
    assert f'0 of {pixels} pixels differ.' in one(kernels, '.shown').text


def test_images_are_zoomed_without_smoothing(kernels: Chrome) -> None:
    image = one(kernels, '.stage img')
    assert image.value_of_css_property('image-rendering') == 'pixelated'
    for zoom in [1, 2, 4]:
        choose(kernels, zoom=f'{zoom}\u00d7')
        assert (image.size['width'], image.size['height']) == (zoom * SIZE[0], zoom * SIZE[1])
    choose(kernels, zoom='fit')
    assert image.size['width'] == one(kernels, '.window').get_property('clientWidth')


def test_printing_shows_one_image_and_no_controls(kernels: Chrome) -> None:
    choose(kernels, view='flip')
    one(kernels, '[name=flip]').click()
    kernels.execute_cdp_cmd('Emulation.setEmulatedMedia', {'media': 'print'})
    try:
        assert visible_image(kernels) == 'box, rendered by simple-bvh, funky-kd'
        assert not any(control.is_displayed() for control in every(kernels, 'select, input, nav'))
        assert 'Rendered by simple-bvh.' in texts(kernels, '.printed')
    finally:
        kernels.execute_cdp_cmd('Emulation.setEmulatedMedia', {'media': ''})


def test_controls_have_names(kernels: Chrome) -> None:
    controls: list[Any] = every(kernels, 'form select, form input, form button')
    assert all(control.accessible_name for control in controls if control.is_displayed())
