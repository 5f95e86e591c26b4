#include "render/export/matplotlib_script.hpp"

#include <fmt/format.h>

#include "render/export/python_text.hpp"

namespace mapproof {

std::string script_colour(Colour of) { return "\"" + hex(of) + "\""; }

std::string script_head(const std::string& id, const std::string& title, const Theme& theme) {
  return fmt::format(
      "#!/usr/bin/env python3\n"
      "# Draws {0} of mapproof by matplotlib: python3 {0}.py [FILE]; without FILE, {0}.pdf.\n"
      "import sys\n\n"
      "import matplotlib\n\n"
      "matplotlib.use(\"Agg\")\n"
      "import matplotlib.pyplot as plt\n"
      "import numpy as np\n"
      "from numpy import inf, nan\n\n"
      "TITLE = {1}\n"
      "plt.rcParams.update({{\n"
      "    \"font.family\": \"DejaVu Sans\", \"font.size\": {2}, \"axes.labelsize\": {2},\n"
      "    \"xtick.labelsize\": {3}, \"ytick.labelsize\": {3}, \"axes.titlesize\": {2},\n"
      "    \"legend.fontsize\": {2}, \"figure.titlesize\": {4}, \"axes.linewidth\": {5},\n"
      "    \"savefig.dpi\": {6}, \"figure.facecolor\": {7}, \"axes.facecolor\": {7},\n"
      "    \"text.color\": {8}, \"axes.labelcolor\": {8}, \"xtick.color\": {8}, \"ytick.color\": "
      "{8},\n"
      "    \"axes.edgecolor\": {8}, \"axes.axisbelow\": True,\n"
      "}})\n\n",
      id, python_text(title), python_number(theme.font_pt), python_number(theme.tick_font_pt),
      python_number(theme.title_font_pt), python_number(theme.hairline_pt),
      python_number(theme.dpi), script_colour(theme.background), script_colour(theme.text));
}

std::string script_legend() {
  return "def legend(ax):\n"
         "    \"\"\"Each label once.\"\"\"\n"
         "    handles, labels = ax.get_legend_handles_labels()\n"
         "    once = dict(zip(labels, handles))\n"
         "    if once:\n"
         "        ax.legend(once.values(), once.keys(), loc=\"best\")\n\n\n";
}

std::string script_tail(const std::string& id, const std::string& title,
                        const std::vector<Note>& notes) {
  std::string head;
  if (!title.empty()) head = title;
  for (const Note& note : notes) head += (head.empty() ? "" : "\n") + note.text;
  std::string out;
  if (!head.empty()) out += fmt::format("fig.suptitle({}, wrap=True)\n", python_text(head));
  return out + fmt::format("fig.savefig(sys.argv[1] if len(sys.argv) > 1 else \"{}.pdf\")\n", id);
}

}  // namespace mapproof
