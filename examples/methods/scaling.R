# Classical scaling as a method of mapproof (protocol 1): Rscript scaling.R
input <- file("stdin", "rb")
field <- function(line, key) sub(paste0('.*"', key, '":("[^"]*"|[^,}]*).*'), "\\1", line)
# A line of a stream that also has binary numbers.
read_line <- function() {
  bytes <- raw(0)
  repeat {
    byte <- readBin(input, "raw", 1)
    if (length(byte) == 0) return(NULL)
    if (byte == as.raw(10)) return(rawToChar(bytes))
    bytes <- c(bytes, byte)
  }
}
while (!is.null(line <- read_line())) {
  rows <- as.integer(field(line, "rows"))
  columns <- as.integer(field(line, "columns"))
  numbers <- readBin(input, "double", rows * columns, size = 8, endian = "little")
  distances <- matrix(numbers, rows, columns, byrow = TRUE)
  seen <- rowSums(is.finite(distances)) > 1
  answer <- '"error":"not all distances are known"'
  if (sum(seen) > 2 && all(is.finite(distances[seen, seen]))) {
    map <- matrix(NA, rows, 2)
    map[seen, ] <- cmdscale(distances[seen, seen], k = 2)
    text <- ifelse(seen, sprintf("[%.17g,%.17g]", map[, 1], map[, 2]), "null")
    answer <- paste0('"coordinates":[', paste(text, collapse = ","), "]")
  }
  cat('{"id":', field(line, "id"), ",", answer, "}\n", sep = "")
  flush(stdout())
}
