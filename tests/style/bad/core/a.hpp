#include "config/b.hpp"
#include "tests/x.hpp"
#include <yaml-cpp/yaml.h>
#include <hdf5.h>
#include <nlohmann/json.hpp>
#include <CLI/CLI.hpp>
#include <vtkPoints.h>
