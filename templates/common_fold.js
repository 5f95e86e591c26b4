// What few readers need is folded on the screen, and whole on paper and without a script.

// With more affected runs than this, their lists stay folded on paper, too.
const kMostOnPaper = 60;

// Opens an element and all that is folded around it.
function unfold(element) {
  const own = element.querySelector(":scope > details.fold");
  for (let each = own ?? element; each; each = each.parentElement) {
    if (each.localName === "details") each.open = true;
  }
}

// Null where the page has no such element, and of a name that is not UTF-8.
function targetOfLink() {
  try {
    return document.getElementById(decodeURIComponent(location.hash.slice(1)));
  } catch {
    return null;
  }
}

// The target of a link may be folded: it is opened, and then scrolled to.
function unfoldTarget() {
  const target = targetOfLink();
  if (!target) return;
  unfold(target);
  target.scrollIntoView();
}

function foldDetails() {
  const folds = document.querySelectorAll("details.fold, .folded > details");
  const affected = document.querySelectorAll(".affected > details");
  for (const details of folds) details.open = false;
  document.documentElement.classList.add("folds");
  addEventListener("hashchange", unfoldTarget);
  unfoldTarget();
  let closed = [];
  addEventListener("beforeprint", () => {
    const runs = document.querySelectorAll(".affected code").length;
    closed = [...folds, ...(runs <= kMostOnPaper ? affected : [])]
      .filter((details) => !details.open);
    for (const details of closed) details.open = true;
  });
  addEventListener("afterprint", () => {
    for (const details of closed) details.open = false;
  });
}
