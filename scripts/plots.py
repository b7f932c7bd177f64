"""Plots of what evaluate.py measured. `pictures`: the scorer's records, one a picture and prefilter."""
import collections
import os

import matplotlib
matplotlib.use('Agg')
import matplotlib.pyplot as plt  # noqa: E402

SIZE_EDGES_PX = [2.5, 4, 5, 6, 8, 10, 13, 17, 22, 30, 40, 60, 100]
HIDDEN_EDGES = [-.001, .001, .05, .1, .15, .2, .25, .3, .35, .4, .45, .5]


def markers(pictures, kind):
    """All markers of a kind ('boards' or 'targets') that count."""
    return [marker for picture in pictures for marker in picture[kind] if marker['care']]


def is_whole(marker):
    return marker['visible_fraction'] > .999


def recall_over(values, edges):
    """[(lower edge, upper edge, share of hits, number)] of the bins that hold something; values: [(value, hit)]."""
    bins = []
    for low, high in zip(edges[:-1], edges[1:]):
        hits = [hit for value, hit in values if low <= value < high]
        if hits:
            bins.append((low, high, sum(hits) / len(hits), len(hits)))
    return bins


def plot_recall(series, edges, label, title, path, logarithmic=False):
    """One stepped line a series: {name: [(value, hit)]}."""
    figure, axes = plt.subplots(figsize=(8, 4.5))
    for name, values in series.items():
        bins = recall_over(values, edges)
        if not bins:
            continue
        line, = axes.plot([(low + high) / 2 for low, high, _, _ in bins], [recall for _, _, recall, _ in bins],
                          marker='o', label='%s (%d)' % (name, len(values)))
        for low, high, recall, count in bins:
            axes.annotate(str(count), ((low + high) / 2, recall), textcoords='offset points', xytext=(0, 6),
                          ha='center', fontsize=7, color=line.get_color())
    if logarithmic:
        axes.set_xscale('log')
        axes.set_xticks(edges)
        axes.set_xticklabels(['%g' % edge for edge in edges])
        axes.minorticks_off()
    axes.set(xlabel=label, ylabel='recall', ylim=(-.02, 1.08), title=title)
    axes.grid(alpha=.3)
    if axes.get_legend_handles_labels()[0]:
        axes.legend(loc='lower left')
    figure.tight_layout()
    figure.savefig(path, dpi=110)
    plt.close(figure)


def plot_lighting(pictures, path):
    """Recall and precision of both kinds for each level of the factor "lighting"."""
    counts = collections.defaultdict(collections.Counter)
    for picture in pictures:
        if 'lighting' in picture['factors']:
            for kind in ('checkerboard', 'target'):
                counts[picture['factors']['lighting']].update(
                    {(kind, key): picture[kind][key] for key in ('tp', 'fp', 'fn')})
    levels = sorted(counts)
    figure, axes = plt.subplots(figsize=(8, 4.5))
    bars = [(kind, name, other) for kind in ('checkerboard', 'target')
            for name, other in (('recall', 'fn'), ('precision', 'fp'))]
    for index, (kind, name, other) in enumerate(bars):
        found = [counts[level][kind, 'tp'] for level in levels]
        total = [hits + counts[level][kind, other] for level, hits in zip(levels, found)]
        share = [hits / count if count else 0 for hits, count in zip(found, total)]
        axes.bar([x + .2 * (index - 1.5) for x in range(len(levels))], share, .2, label='%s %s' % (kind, name))
    axes.set_xticks(range(len(levels)))
    axes.set_xticklabels(levels)
    axes.set(ylabel='share', ylim=(0, 1.2), title='By lighting')
    axes.grid(axis='y', alpha=.3)
    axes.legend(loc='upper center', ncol=4, fontsize='small')
    figure.tight_layout()
    figure.savefig(path, dpi=110)
    plt.close(figure)


def write_all(pictures, folder):
    boards, targets = markers(pictures, 'boards'), markers(pictures, 'targets')
    sizes = {'checkerboards': [(board['min_square_px'], board['hit']) for board in boards if is_whole(board)],
             'targets': [(target['ring_px'], target['hit']) for target in targets if is_whole(target)]}
    plot_recall(sizes, SIZE_EDGES_PX, 'shortest square side, ring width [px]', 'Recall over size, nothing hidden',
                os.path.join(folder, 'recall_size.png'), logarithmic=True)
    plot_recall({'checkerboards': [(1 - board['visible_fraction'], board['hit']) for board in boards],
                 'targets': [(1 - target['visible_fraction'], target['hit']) for target in targets]}, HIDDEN_EDGES,
                'hidden share', 'Recall over occlusion', os.path.join(folder, 'recall_hidden.png'))
    plot_lighting(pictures, os.path.join(folder, 'lighting.png'))
