% Classical scaling as a method of mapproof (protocol 1): octave-cli --quiet scaling.m
1;
function text = field(line, key)
  text = regexp(line, ['"' key '":("[^"]*"|[^,}]*)'], "tokens"){1}{1};
end
while ischar(line = fgetl(stdin))
  shape = [str2double(field(line, "columns")), str2double(field(line, "rows"))];
  D = fread(stdin, shape, "double", 0, "ieee-le")';
  seen = sum(isfinite(D), 2) > 1;
  S = D(seen, seen) .^ 2;
  if sum(seen) < 3 || !all(isfinite(S(:)))
    answer = '"error":"not all distances are known"';
  else
    J = eye(rows(S)) - 1 / rows(S);
    [V, L] = eig((-J * S * J / 2 + (-J * S * J / 2)') / 2);
    [values, order] = sort(diag(L), "descend");
    map = nan(rows(D), 2);
    map(seen, :) = V(:, order(1:2)) .* sqrt(max(values(1:2), 0))';
    text = strrep(sprintf("[%.17g,%.17g],", map'), "[NaN,NaN]", "null");
    answer = ['"coordinates":[' text(1:end-1) "]"];
  end
  printf('{"id":%s,%s}\n', field(line, "id"), answer);
  fflush(stdout);
end
