"""Functions of the page of a study by themselves: its scripts let none of their names out."""
import pathlib


def check_ground(page, expect):
    """Rigid ground from 0 at x = 0 to -10 at x = 100, seen from x = 20 to 60 and to 140."""
    code = pathlib.Path(__file__).parents[2].joinpath("study/page/scripts/section.js").read_text()

    def ends(right):
        # 10 pixels a metre across and up, as fit() gives for that width; y counts from 0 down.
        return page.run("""(() => {
            const extent = (v) => [Math.min(...v), Math.max(...v)],
              draw = (name, attributes) => attributes,
              materialColours = (soils) => soils;
            %s
            const d = new SectionDrawing({ soils: [{ rings: [[[20, 0], [60, 0], [60, -5]]] }],
              water: [], ground: [[0, 0], [100, -10]] }, %g);
            d.fit(0, 10 * (%g - 20), 0);
            const edge = d.ground()[1].d.slice(1).split("L").map((xy) => xy.split(" ").map(Number));
            const up = (p) => -p[1] / (10 * d.larger);
            return [up(edge[0]), up(edge[edge.length - 1])]; })()""" % (code, right, right))

    for right, low in ((60, -6), (140, -10)):
        left_end, right_end = ends(right)
        expect(f"ground at the edges is as high as there ({left_end:.2f}, {right_end:.2f})",
               abs(left_end + 2) < 0.02 and abs(right_end - low) < 0.02)


def check_zero(page, expect):
    """What holds values that are all 0 begins there."""
    code = pathlib.Path(__file__).parents[2].joinpath("study/page/scripts/scatter.js").read_text()

    def around(values):
        return page.run("""(() => {
            const extent = (v) => [Math.min(...v), Math.max(...v)];
            %s
            return Scatter.prototype.around(%s, (v) => [v, 0]); })()""" % (code, values))

    low, high = around([0, 0])
    expect(f"runouts of 0 are seen from 0 on ({low}, {high})", low == 0 and high > 0)
    expect("control: others have room on both sides", around([-1, -1])[0] < -1 < around([-1, -1])[1]
           and around([3, 3])[0] < 3)
