// Recall and spurious contacts per scene, as a table with heat colours.
import {controlBar, radios, select} from "../controls";
import {h, p} from "../dom";
import {term} from "../glossary";
import {heatTable} from "../heat_table";
import type {Section} from "../section";

type Measure = "recall" | "spurious";

export const levels: Section = {
  id: "levels",
  title: "Recall and spurious rate by scene",
  short: "Scene by scene",
  build(page) {
    if (page.scenes.length === 0) return [];
    let level = 0,
      measure: Measure = "recall";
    const place = h("div");
    const update = (): void =>
      place.replaceChildren(
        measure === "recall"
          ? heatTable(page.levels[level].recall, "--missed", "Recall per detector and scene")
          : heatTable(
              page.levels[level].spurious,
              "--spurious",
              "Spurious rate per detector and scene",
            ),
      );
    update();
    const names = page.levels.map((one, i): [string, string] => [
      String(i),
      i === 0 ? "each detector's finest" : one.level,
    ]);
    return [
      p(
        term("recall", "Recall"),
        " is the share of true contacts that was found: 1 is perfect, and any other number has a colour. " +
          "The ",
        term("spurious"),
        " rate is the share of reports that are no contact: 0 is perfect. A dash: nothing to find, or nothing " +
          "reported. An empty cell: the detector does not claim this ",
        term("level"),
        " there; " +
          "where its finest level is not the same in all scenes, choose a level to have a sum.",
      ),
      controlBar(
        select("Level", names, "0", (value) => {
          level = Number(value);
          update();
        }),
        radios(
          "Shown",
          [
            ["recall", "recall"],
            ["spurious", "spurious rate"],
          ],
          measure,
          (value) => {
            measure = value as Measure;
            update();
          },
        ),
      ),
      place,
    ];
  },
};
