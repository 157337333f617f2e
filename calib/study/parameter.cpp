#include "calib/study/parameter.hpp"
