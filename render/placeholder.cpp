namespace mapproof {}
