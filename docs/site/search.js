// How the search ranks what it finds: pages that explain before names of the reference, and the questions before all.
var Scorer = {
  score: ([page, title, anchor, description, score]) => score + (page === "questions" ? 20 : page.startsWith("records/") ? -10 : 0),
  objNameMatch: 4,
  objPartialMatch: 1,
  objPrio: { 0: 2, 1: 0, 2: -2 },
  objPrioDefault: 0,
  title: 15,
  partialTitle: 7,
  term: 5,
  partialTerm: 2,
};
