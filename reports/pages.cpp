#include "reports/pages.hpp"
