// Classical scaling as a method of mapproof (protocol 1):
//   c++ -std=c++17 -I /usr/include/eigen3 -o scaling scaling.cpp
#include <iostream>
#include <regex>
#include <string>

#include <Eigen/Dense>

std::string field(const std::string& line, const std::string& key) {
  std::smatch found;
  std::regex_search(line, found, std::regex("\"" + key + "\":(\"[^\"]*\"|[^,}]*)"));
  return found[1];
}

int main() {
  std::cout.precision(17);
  for (std::string line; std::getline(std::cin, line);) {
    const int n = std::stoi(field(line, "rows"));
    Eigen::MatrixXd D(n, n);
    std::cin.read(reinterpret_cast<char*>(D.data()), std::stol(field(line, "bytes")));
    std::cout << "{\"id\":" << field(line, "id");
    if (!D.allFinite()) {
      std::cout << ",\"error\":\"not all distances are known\"}" << std::endl;
      continue;
    }
    const Eigen::MatrixXd J = Eigen::MatrixXd::Identity(n, n).array() - 1.0 / n;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(
        -0.5 * J * D.cwiseAbs2() * J.transpose());
    const Eigen::MatrixXd map = eigen.eigenvectors().rightCols(2) *
        eigen.eigenvalues().tail(2).cwiseMax(0.0).cwiseSqrt().asDiagonal();
    for (int i = 0; i < n; ++i)
      std::cout << (i ? "," : ",\"coordinates\":[") << '[' << map(i, 0) << ',' << map(i, 1) << ']';
    std::cout << "]}" << std::endl;
  }
}
