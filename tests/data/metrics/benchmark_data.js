window.BENCHMARK_DATA = {
  "lastUpdate": 1764115200000,
  "repoUrl": "https://github.com/me/solver",
  "entries": {
    "Solver speed": [
      {
        "commit": {"id": "1111111111111111111111111111111111111111", "message": "first", "timestamp": "2026-11-24T02:30:00Z", "url": "https://github.com/me/solver/commit/1111111111111111111111111111111111111111"},
        "date": 1764028800000,
        "tool": "customSmallerIsBetter",
        "benches": [{"name": "solve 1000", "value": 12.5, "unit": "ms"}]
      },
      {
        "commit": {"author": {"name": "M"}, "id": "2222222222222222222222222222222222222222", "message": "second", "timestamp": "2026-11-25T02:30:00Z", "url": "https://github.com/me/solver/commit/2222222222222222222222222222222222222222"},
        "date": 1764115200000,
        "tool": "customSmallerIsBetter",
        "benches": [
          {"name": "solve 1000", "value": 13.0, "unit": "ms", "range": "± 0.4", "extra": "20 runs"},
          {"name": "peak memory", "value": 81.25, "unit": "MiB"}
        ]
      }
    ],
    "Throughput": [
      {
        "commit": {"id": "2222222222222222222222222222222222222222", "url": "https://github.com/me/solver/commit/2222222222222222222222222222222222222222"},
        "date": 1764115200000,
        "tool": "customBiggerIsBetter",
        "benches": [{"name": "poses", "value": 51234, "unit": "poses/s", "extra": "single thread"}]
      }
    ]
  }
}
