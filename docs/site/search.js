// How the search ranks what it finds: pages that explain before names of the reference, the questions before all, and records
// and the changelog last.
var Scorer = {
  score: ([page, title, anchor, description, score]) =>
    score + (page === "questions" ? 20 : page === "changelog" || page.startsWith("records/") ? -10 : 0),
  objNameMatch: 4,
  objPartialMatch: 1,
  objPrio: { 0: 2, 1: 0, 2: -2 },
  objPrioDefault: 0,
  title: 15,
  partialTitle: 7,
  term: 5,
  partialTerm: 2,
};
