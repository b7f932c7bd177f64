"""The tables of an evaluation in Markdown: what README quotes of it.

`results`: {set: the scorer's result}; `peers`: {peer: {set: the scorer's result}}.
"""
import datetime

PAPER_TABLE_5 = {  # %: all pictures, those without hard shadows
    'Checkerboard precision': (98.2, 98.5), 'Checkerboard recall': (94.5, 98.8), 'Checkerboard F-Score': (95.5, 98.5),
    'Target precision': (92.0, 98.0), 'Target recall': (89.8, 97.2), 'Target F-Score': (90.3, 97.2),
    'Target color accuracy': (79.5, 83.5)}
PAPER_ANOVA = {  # Pr(>F) in section 4.2, hard shadows included
    'checkerboard': {'environment': '< 2e-16', 'lighting': '< 2e-16', 'camBrand': '0.469', 'filters': '0.212',
                     'perspective': '0.705'},
    'target': {'environment': '1.4e-07', 'lighting': '< 2e-16', 'camBrand': '0.003', 'filters': '0.993',
               'perspective': '0.002'}}
SIGNIFICANT = .05


def table(head, rows):
    lines = [head, ['---'] * len(head), *rows]
    return ''.join('| %s |\n' % ' | '.join(str(cell) for cell in line) for line in lines)


def percent(share):
    return '-' if share is None else '%.1f' % (100 * share)


def pixels(result, key):
    return '%.3f' % result[key] if key in result else '-'


def counts(kind):
    return '%(tp)d / %(fp)d / %(fn)d' % kind


def processor():
    with open('/proc/cpuinfo') as file:
        return next((line.split(':')[1].strip() for line in file if line.startswith('model name')), 'unknown processor')


def sets_table(results):
    head = ['set (pictures)', 'boards found / wrong / missed', 'precision, recall %', 'corners RMS px',
            'targets found / wrong / missed', 'precision, recall %', 'centres RMS px', 'ring colours %',
            'median, max ms']
    rows = []
    for name, result in results.items():
        pool = result['sets'][name]['all']
        boards, targets, time = pool['checkerboard'], pool['target'], pool.get('time_ms')
        rows.append(['%s (%d)' % (name, pool['pictures']), counts(boards),
                     '%s, %s' % (percent(boards['precision']), percent(boards['recall'])),
                     pixels(pool, 'corner_rms_px'), counts(targets),
                     '%s, %s' % (percent(targets['precision']), percent(targets['recall'])),
                     pixels(pool, 'target_center_rms_px'), percent(pool['color_accuracy']),
                     '%.0f, %.0f' % (time['median'], time['max']) if time else '-'])
    return table(head, rows)


def peers_table(results, peers):
    """Boards found / wrong / missed of each peer beside ours; a peer counts on the sets it ran on."""
    rows = []
    for name, result in results.items():
        if any(name in scores for scores in peers.values()):
            ours = result['sets'][name]['all']['checkerboard']
            cells = []
            for scores in peers.values():
                pool = scores[name]['sets'][name]['all'] if name in scores else None
                cells.append('-' if pool is None else '%s, %s px, %.0f ms' % (
                    counts(pool['checkerboard']), pixels(pool, 'corner_rms_px'), pool['time_ms']['median']))
            rows.append([name, counts(ours), *cells])
    return table(['set', 'ours', *peers], rows)


def experiment_table(experiment):
    """The paper's Table 5 beside ours."""
    rows = [[name, *(percent(share) for share in experiment['table5'][name]), *('%.1f' % value for value in paper)]
            for name, paper in PAPER_TABLE_5.items()]
    return table(['', 'ours, all', 'ours, no hard shadow', 'paper, all', 'paper, no hard shadow'], rows)


def anova_tables(experiment):
    """The paper's analysis of variance of both F-scores over all pictures, hard shadows included."""
    text = ''
    for kind, paper in PAPER_ANOVA.items():
        terms = experiment['anova'].get(kind + ', all')
        if terms is None:
            text += '\n%s F-score: the same in every picture, so no factor has an influence.\n' % kind.capitalize()
            continue
        rows = []
        for term in terms:
            p = term['p']
            rows.append([term['term'], term['df'], '%.4f' % term['sum_sq'], '%.5f' % term['mean_sq'],
                         '' if p is None else '%.2f' % term['F'],
                         '' if p is None else '%.3g%s' % (p, ' *' if p < SIGNIFICANT else ''),
                         paper.get(term['term'], '')])
        text += '\n%s F-score (* below %g)\n\n' % (kind.capitalize(), SIGNIFICANT) + table(
            ['', 'Df', 'Sum Sq', 'Mean Sq', 'F value', 'Pr(>F)', 'paper: Pr(>F)'], rows)
    return text


def size_table(results):
    """Recall over the size of squares and rings, of the sets that were made for it."""
    text = ''
    for kind, what in (('size_checkerboard', 'square side'), ('size_target', 'ring width')):
        rows = [[name, *('%g to %g: %s (%d)' % (bin_['lo'], bin_['hi'], percent(bin_['recall']), bin_['n'])
                         for bin_ in results[name]['sets'][name][kind]['bins'] if bin_['lo'] < 9)]
                for name in ('distance',) if name in results]
        for row in rows:
            text += '\nRecall %% by %s in px (number), %s: %s\n' % (what, row[0], '; '.join(row[1:]))
    return text


def write(results, peers, experiment, path):
    """Writes the tables of all sets into the file `path`; `experiment`: name of the paper's experiment's set."""
    text = '%s, %s\n\n' % (datetime.date.today().isoformat(), processor()) + sets_table(results) + size_table(results)
    if peers:
        text += '\nBoards of others, told the number of squares\n\n' + peers_table(results, peers)
    if 'table5' in results.get(experiment, {}).get('sets', {}).get(experiment, {}):
        chapter = results[experiment]['sets'][experiment]
        text += '\n' + experiment_table(chapter) + anova_tables(chapter)
    with open(path, 'w') as file:
        file.write(text)
