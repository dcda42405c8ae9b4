#include "dataset/shared_products.h"

#include "dataset/seabed_files.h"
#include "mission/dataset_names.h"

namespace sonarsim {

std::vector<std::string> shared_products(const Mission& mission) {
    std::vector<std::string> products;
    if (mission.scene.seabed) products = seabed_file_names();
    if (mission.vehicle.navigation != NavigationConfig{}) products.push_back(navigation_name);
    return products;
}

}  // namespace sonarsim
